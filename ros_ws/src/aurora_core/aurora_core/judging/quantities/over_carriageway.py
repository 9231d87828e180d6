# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How much of a leg lies over a street."""

from __future__ import annotations

from typing import Literal

import numpy as np

from aurora_core.judging.build import Inputs, Source, number, share_condition
from aurora_core.judging.evaluation import Context, Evaluation, Missing
from aurora_core.judging.quantity import OfMission
from aurora_core.judging.route import flown_legs, route_topics
from aurora_core.judging.shares import share_of
from aurora_core.knowledge.world import SurfaceKind
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.quantity import QuantityName


class OverCarriageway(OfMission):
    """Share of the samples of the best leg that lie over a carriageway."""

    name = QuantityName.OVER_CARRIAGEWAY
    kind: Literal['over_carriageway'] = 'over_carriageway'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the share of the best leg; another one may still become the best."""
        uav = self.mission.uav
        missing = context.phase_missing(condition, self.mission)
        if missing is not None:
            return missing
        flown = flown_legs(context, condition, self.mission)
        if not flown:
            return Missing(reason=Reason.EMPTY_PHASE, story=f'{uav} flew no leg of its route')
        driving = context.view.geometry.surfaces(SurfaceKind.DRIVING)
        first, last = flown[0].start, flown[-1].stop
        over = np.zeros(context.view.ticks, dtype=np.bool_)
        over[first:last] = driving.contains(context.view.reference(uav)[first:last, :2])
        shares = [
            int(np.count_nonzero(over[leg.start : leg.stop])) / (leg.stop - leg.start)
            for leg in flown
        ]
        best = int(np.argmax(shares))
        ticks = np.arange(flown[best].start, flown[best].stop, dtype=np.intp)
        what = f'on its best leg {uav} was over a carriageway'
        return share_of(context, ticks, over, None, what, route_topics(condition), growing=False)


def implied(inputs: Inputs, mission: MissionArguments, source: Source) -> Condition:
    """Return that one leg of a route follows a street."""
    share = inputs.tolerances.over_carriageway_share
    return share_condition(
        id=f'{mission.mission}.over_streets',
        sentence=(
            f'{mission.uav} flies at least one leg over a carriageway '
            f'({number(100 * share)} % of the leg)'
        ),
        of=(mission.uav,),
        share=share,
        arguments=OverCarriageway(**inputs.common, mission=mission),
        source=source,
    )

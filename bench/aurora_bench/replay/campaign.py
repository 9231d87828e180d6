# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One prompt through the graph, then its bag through replay: four verdicts are compared."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from aurora_bench.replay.prompts import Case
from aurora_cli.installed import installed
from aurora_core.pipeline.verification import verify_stage
from aurora_msgs.msg import Verdict
from aurora_ros import interfaces as on
from aurora_system_tests.graph import RunningGraph

_RUN_LIMIT_S = 600.0
_REPLAY_LIMIT_S = 300.0
_REPLAY = 'import sys\nfrom aurora_nodes.replay import main\nsys.exit(main())'


@dataclass(frozen=True, kw_only=True)
class Round:
    """What one prompt gave.

    Attributes:
        case: The prompt.
        status: Of the run.
        conditions: How many margins there are.
        ticks: Length of the run.
        live: The live verdict is that of the bag, byte by byte.
        bag: The verdict of the bag is the one of a fresh computation, byte by byte.
        replayed: The verdict heard in the replay is that of the bag, byte by byte.
        hashes: One trace hash in all of them.
        replay_code: Exit code of replay.
        note: What went wrong.
    """

    case: Case
    status: str
    conditions: int = 0
    ticks: int = 0
    live: bool = False
    bag: bool = False
    replayed: bool = False
    hashes: bool = False
    replay_code: int = -1
    note: str = ''

    @property
    def equal(self) -> bool:
        """Whether every comparison holds."""
        return self.live and self.bag and self.replayed and self.hashes


class Campaign:
    """Runs prompts in one graph.

    Args:
        graph: Every node of it is running.
    """

    def __init__(self, graph: RunningGraph) -> None:
        self._graph = graph
        self._heard: list[Verdict] = graph.play.collect(on.VERDICT)

    def run(self, case: Case) -> Round:
        """Run a prompt, verify its bag again, replay it, compare."""
        self._heard.clear()
        response = self._graph.play.call(
            on.RUN_PROMPT,
            _RUN_LIMIT_S,
            prompt=case.prompt,
            wait=True,
            options_json=case.options_json,
        )
        bag = Path(response.run_dir) / 'bag.0'
        if not bag.is_dir():
            return Round(case=case, status=response.status, note='nothing was executed')
        run = {verdict.source: verdict for verdict in self._heard}
        if run.keys() != {Verdict.LIVE, Verdict.BAG}:
            return Round(case=case, status=response.status, note=f'verdicts heard: {len(run)}')
        live, judged = run[Verdict.LIVE], run[Verdict.BAG]
        again = verify_stage(installed(), bag)
        self._heard.clear()
        replay = self._replay(bag)
        replayed = self._heard[-1] if self._heard else Verdict()
        document: dict[str, Any] = json.loads(replay.stdout) if replay.stdout else {}
        hashes = {
            live.trace_sha256,
            judged.trace_sha256,
            replayed.trace_sha256,
            document.get('trace_sha256', ''),
        }
        return Round(
            case=case,
            status=response.status,
            conditions=len(again.results),
            ticks=int(document.get('ticks', 0)),
            live=live.verdict_json == judged.verdict_json,
            bag=judged.verdict_json == again.canonical_json(),
            replayed=replayed.verdict_json == judged.verdict_json
            and bool(document.get('recorded', {}).get('equal')),
            hashes=len(hashes) == 1,
            replay_code=replay.returncode,
            note='' if replay.stdout else replay.stderr.strip()[-300:],
        )

    def _replay(self, bag: Path) -> subprocess.CompletedProcess[str]:
        domain = self._graph.play.node.context.get_domain_id()
        return subprocess.run(
            [sys.executable, '-c', _REPLAY, str(bag), '--json'],
            env={**os.environ, 'ROS_DOMAIN_ID': str(domain)},
            capture_output=True,
            text=True,
            timeout=_REPLAY_LIMIT_S,
            check=False,
        )

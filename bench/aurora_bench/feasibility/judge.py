# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the product says of one request, and whether its certificates hold."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

from aurora_bench.feasibility.families import Case
from aurora_core.outcomes.feasibility import Certificate, Feasibility
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.pipeline.functions import check_stage, parse_stage, understood
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.recheck import recheck
from aurora_core.report.build import refusal_certificate

SEED = 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Judged:
    """What became of a case.

    Attributes:
        said: `feasible`, `unknown`, `infeasible`, or `not read` where there is no request.
        certificates: Why it was refused.
        document: The specification as JSON, or the prompt alone.
        valid: Of each certificate, whether the re-check accepts it.
        read_s: Wall seconds of the reader.
        check_s: Wall seconds of the verdict after that.
        check_cpu_s: Processor seconds of it, which other work on the machine changes less.
        recheck_s: Of checking all certificates again.
    """

    case: Case
    said: str
    certificates: tuple[Certificate, ...]
    document: dict[str, Any]
    valid: tuple[bool, ...]
    read_s: float
    check_s: float
    check_cpu_s: float
    recheck_s: float

    @property
    def refused(self) -> bool:
        """Whether it was refused."""
        return self.said == Feasibility.INFEASIBLE.value

    @property
    def reasons(self) -> tuple[str, ...]:
        """The reasons of the certificates."""
        return tuple(dict.fromkeys(c.reason for c in self.certificates))

    @property
    def right_reason(self) -> bool:
        """Whether a fair reason is among them."""
        return bool(set(self.reasons) & set(self.case.because))


def judged(known: Knowledge, map_name: str, case: Case) -> Judged:
    """Read a case, check it, and check its certificates again."""
    begin = time.perf_counter()
    if case.spec is None:
        outcome = parse_stage(known, case.prompt, map_name, SEED)
    else:
        outcome = understood(known, ParseOutcome(spec=case.spec))
    read, read_cpu = time.perf_counter(), time.process_time()
    said, proofs = 'not read', tuple(refusal_certificate(r) for r in outcome.refusals)
    document: dict[str, Any] = {'prompt': case.prompt}
    if proofs:
        said = Feasibility.INFEASIBLE.value
    elif outcome.agsg is not None:
        verdict = check_stage(known, outcome.agsg)
        said, proofs = verdict.result.value, verdict.certificates
        document = outcome.agsg.spec.model_dump(mode='json')
    checked, checked_cpu = time.perf_counter(), time.process_time()
    valid = tuple(recheck(proof, document).valid for proof in proofs)
    return Judged(
        case=case,
        said=said,
        certificates=proofs,
        document=document,
        valid=valid,
        read_s=read - begin,
        check_s=checked - read,
        check_cpu_s=checked_cpu - read_cpu,
        recheck_s=time.perf_counter() - checked,
    )

# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Parts of the offline reader left out in turn, and put back."""

from __future__ import annotations

from aurora_bench.fidelity.answer import offline_answer
from aurora_bench.fidelity.leave_out import instead, parts
from aurora_core.parsing.constructions.missions import mission


def test_a_part_left_out_changes_what_is_read_and_is_put_back() -> None:
    prompt = 'A drone hovers over City Hall at 40 m.'
    part = next(p for p in parts() if p.function is mission)
    before = offline_answer(prompt)
    with instead({part.function: part.left_out}):
        without = offline_answer(prompt)
    assert before.spec is not None
    assert [m.target for m in before.spec.missions] == ['landmark:City Hall']
    assert without != before
    assert offline_answer(prompt) == before

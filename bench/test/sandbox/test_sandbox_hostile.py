# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Programs that try to get out end as they have to, and nothing outside has changed."""

from __future__ import annotations

from pathlib import Path

import pytest

from aurora_bench.sandbox import process
from aurora_bench.sandbox.hostile import ESCAPED, HOSTILE, Hostile
from aurora_bench.sandbox.process import ContainedProgram, End, chosen_way
from aurora_bench.sandbox.ways import ProgramLimits, SandboxError, WayName

SECRET = 'the secret of the file outside'


@pytest.fixture
def contained() -> None:
    """Skip where nothing contains a program: there it is refused, which is tested below."""
    try:
        chosen_way()
    except SandboxError as err:
        pytest.skip(str(err))


@pytest.mark.usefixtures('contained')
@pytest.mark.parametrize('hostile', HOSTILE, ids=lambda h: h.name)
def test_hostile_program_is_contained(hostile: Hostile, tmp_path: Path) -> None:
    canary = tmp_path / 'canary'
    canary.write_text(SECRET)
    # Who sleeps is ended soon; everybody else may be slow on a loaded machine.
    wall_s = 1.0 if hostile.ends == {End.WALL} else 120.0
    # Filling memory takes time, too: that is not to run out first.
    cpu_s = 30 if hostile.ends == {End.MEMORY} else 1
    limits = ProgramLimits(cpu_s=cpu_s, wall_s=wall_s, requests=20_000)
    with ContainedProgram(hostile.text.format(canary=str(canary)), limits) as program:
        ended = program.ended()
    assert ended.end in hostile.ends, ended
    assert ESCAPED not in ended.told
    assert SECRET not in ended.told
    assert canary.read_text() == SECRET
    assert sorted(p.name for p in tmp_path.iterdir()) == ['canary']


def test_there_are_forty_of_different_names() -> None:
    assert len({h.name for h in HOSTILE}) == len(HOSTILE) >= 40


def test_escape_is_told_where_nothing_contains() -> None:
    """What the programs try is possible in itself: they would say so."""
    text = next(h.text for h in HOSTILE if h.name == 'datagram')
    said: list[str] = []
    exec(text, {'print': said.append})  # noqa: S102
    assert said == [ESCAPED]


@pytest.mark.usefixtures('contained')
def test_harmless_program_computes_and_finishes() -> None:
    text = 'import math, json, random\nprint(math.hypot(3, 4), random.Random(1).random() < 1)'
    with ContainedProgram(text) as program:
        ended = program.ended()
    assert ended.end is End.FINISHED
    assert ended.told == '5.0 True\n'


@pytest.mark.usefixtures('contained')
def test_requests_and_answers() -> None:
    text = (
        'from aurora_scene import scene, SceneError\n'
        'print(scene.step(3))\n'
        'try: scene.resume("ego")\nexcept SceneError as err: print(err)\n'
    )
    with ContainedProgram(text) as program:
        assert program.receive() == {'do': 'step', 'ticks': 3}
        program.send({'is': 0.15})
        assert program.receive() == {'do': 'resume', 'name': 'ego'}
        program.send({'error': 'no such body'})
        assert program.receive() is None
        ended = program.ended()
    assert ended.end is End.FINISHED
    assert ended.told == '0.15\nno such body\n'


@pytest.mark.usefixtures('contained')
def test_answer_that_nobody_reads_ends_it() -> None:
    with ContainedProgram('while True: pass', ProgramLimits(cpu_s=60, wall_s=1.0)) as program:
        program.send({'is': 'x' * (1 << 20)})
        assert program.ended().end is End.WALL


def test_refused_when_nothing_contains(monkeypatch: pytest.MonkeyPatch) -> None:
    """A way without walls is found out by its probe, and then no program is run."""

    def bare(way: WayName, limits: ProgramLimits, root: Path) -> tuple[str, ...]:
        import sys

        guard = str(Path(process.__file__).parent / 'inside' / 'guard.py')
        numbers = (str(limits.cpu_s), str(limits.memory_bytes), str(limits.output_bytes))
        return (sys.executable, '-I', '-S', '-B', guard, *numbers)

    chosen_way.cache_clear()
    monkeypatch.setattr(process, 'command', bare)
    try:
        with pytest.raises(SandboxError, match='nothing contains it'):
            ContainedProgram('print(1)')
    finally:
        chosen_way.cache_clear()

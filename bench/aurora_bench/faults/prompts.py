# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Many different prompts in one graph."""

from __future__ import annotations

from aurora_bench.faults.client import Client, trace_hash
from aurora_bench.faults.live_graph import LiveGraph
from aurora_bench.progress import Progress
from aurora_core.document import Document

PROMPTS = (
    'A drone ascends to 40 meters and then follows a motorcycle as it drives through the streets.',
    'In clear weather at midday, a drone flies a rectangular survey route at 30 meters altitude '
    'over the streets around the ego car.',
    'A bus drives ahead of the ego car and an ambulance follows behind it while two background '
    'cars circulate; a drone tracks the bus from 35 meters.',
    'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the ego '
    'when the van comes within 20 meters.',
    'A drone hovers at 20 meters over the ego car for 30 seconds.',
)
# The first prompts fill caches (maps, compiled code): memory counts from here on.
WARM_AFTER = len(PROMPTS)


class PromptRound(Document):
    """One prompt and what came of it."""

    prompt: str
    seed: int
    status: str
    trace_sha256: str
    error: str = ''


class PromptRounds(Document):
    """All of them.

    Attributes:
        repeated_equal: The first prompt, sent again at the end, left the same trace.
        use: Name, memory before and after (KiB), descriptors before and after, of every node.
    """

    rounds: tuple[PromptRound, ...]
    repeated_equal: bool
    use: tuple[tuple[str, int, int, int, int], ...]

    @property
    def held(self) -> bool:
        """Whether everything was as it must be."""
        bad = [one for one in self.rounds if one.status in ('', 'error', 'inconclusive')]
        grown = [row[0] for row in self.use if row[4] > row[3]]
        return not bad and self.repeated_equal and not grown


def run_prompts(graph: LiveGraph, client: Client, count: int, progress: Progress) -> PromptRounds:
    """Send `count` prompts, no two alike, and the first one again."""
    rounds = []
    before = graph.use()
    for number in range(count + 1):
        turn = number % count
        prompt, seed = PROMPTS[turn % len(PROMPTS)], 1 + turn // len(PROMPTS)
        run = client.run(prompt, {'seed': seed})
        rounds.append(
            PromptRound(
                prompt=prompt,
                seed=seed,
                status=str(run.result.status) if run.result is not None else '',
                trace_sha256=trace_hash(run.result),
                error=str(run.result.error_msg) if run.result is not None else run.error,
            )
        )
        progress.step(f'prompt, seed {seed}: {rounds[-1].status} {rounds[-1].error}')
        if number + 1 == min(WARM_AFTER, count):
            before = graph.use()
    after = graph.use()
    first, last = rounds[0], rounds[-1]
    return PromptRounds(
        rounds=tuple(rounds),
        repeated_equal=first.trace_sha256 == last.trace_sha256 != '',
        use=tuple((name, *_pair(before[name], after[name])) for name in before),
    )


def _pair(before: tuple[int, int], after: tuple[int, int]) -> tuple[int, int, int, int]:
    return before[0], after[0], before[1], after[1]

# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.checker BAG --prompts FILE --id ID`: one recording, one annotation."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from aurora_bench.checker import Checked, CheckerError, Outcome, check_bag

FAILED, UNREADABLE, USAGE = 1, 4, 64


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> Any:
        self.print_usage(sys.stderr)
        self.exit(USAGE, f'{self.prog}: {message}\n')


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the answers; return 1 when something does not hold, 4 when nothing can be read."""
    parser = _Parser(prog='aurora_bench.checker', description=__doc__)
    parser.add_argument('bag', type=Path, help='folder of a bag, such as RUN/bag.0')
    parser.add_argument('--prompts', type=Path, required=True, help='prompt file (JSON Lines)')
    parser.add_argument('--id', required=True, help='id of the prompt in that file')
    parser.add_argument('--json', action='store_true', help='print JSON instead of a table')
    options = parser.parse_args(arguments)
    try:
        checked = check_bag(options.bag, _prompt(options.prompts, options.id))
    except CheckerError as error:
        print(f'aurora_bench.checker: {error}', file=sys.stderr)  # noqa: T201
        return UNREADABLE
    print(_as_json(checked) if options.json else _as_table(checked))  # noqa: T201
    failed = any(a.outcome is Outcome.DOES_NOT for a in checked.answers)
    return FAILED if failed else 0


def _prompt(file: Path, prompt_id: str) -> Mapping[str, Any]:
    """Return the line of a prompt file with an id.

    Raises:
        CheckerError: The file cannot be read, or has no such id.
    """
    try:
        lines = file.read_text(encoding='utf-8').splitlines()
        prompts = [json.loads(line) for line in lines if line.strip()]
    except (OSError, ValueError) as error:
        raise CheckerError(f'{file}: no prompt file: {error}; give one in JSON Lines') from error
    for prompt in prompts:
        if isinstance(prompt, dict) and prompt.get('id') == prompt_id:
            return prompt
    raise CheckerError(f'{file}: no prompt {prompt_id!r}; look the id up in the file')


def _as_json(checked: Checked) -> str:
    answers = [
        {'requirement': a.requirement, 'kind': a.kind, 'outcome': a.outcome.value, 'why': a.why}
        for a in checked.answers
    ]
    return json.dumps({'answers': answers, 'binding': checked.binding}, indent=2)


def _as_table(checked: Checked) -> str:
    names = ', '.join(f'{n} = {" ".join(b) or "nobody"}' for n, b in checked.binding.items())
    rows = [(a.requirement, a.kind, a.outcome.value, a.why) for a in checked.answers]
    widths = [max(len(r[k]) for r in rows) for k in range(3)] if rows else [0, 0, 0]
    lines = ['  '.join([*(r[k].ljust(widths[k]) for k in range(3)), r[3]]).rstrip() for r in rows]
    counts = [sum(a.outcome is o for a in checked.answers) for o in Outcome]
    last = f'{counts[0]} hold, {counts[1]} do not, {counts[2]} cannot be told'
    return '\n'.join([f'names: {names or "none"}', *lines, last])


if __name__ == '__main__':
    sys.exit(main())

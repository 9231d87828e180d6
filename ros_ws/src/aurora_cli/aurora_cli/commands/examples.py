# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora examples`: prompts that verify on the bundled map, by category."""

from __future__ import annotations

import yaml
from pydantic import TypeAdapter

from aurora_cli.output import UsageProblem, answer_console, print_json
from aurora_core.knowledge.config_files import config_path
from aurora_core.report.terminal import line, print_table

FILE = 'examples.yaml'
_Categories = TypeAdapter(dict[str, list[str]])


def installed_examples() -> list[tuple[str, str]]:
    """Return category and prompt of every example, in the order of the file.

    Raises:
        ConfigError: The configuration folder lacks the file.
    """
    text = config_path(FILE).read_text('utf-8')
    groups = _Categories.validate_python(yaml.safe_load(text))
    return [(category, prompt) for category, prompts in groups.items() for prompt in prompts]


def examples_command(number: int | None, category: str | None, *, as_json: bool) -> int:
    """Print the examples, those of a category, or one alone; return the exit code.

    Raises:
        UsageProblem: There is no example of this number or category.
    """
    known = installed_examples()
    categories = list(dict.fromkeys(name for name, _ in known))
    if number is not None and not 1 <= number <= len(known):
        raise UsageProblem(f'there is no example {number}; there are 1 to {len(known)}')
    if category is not None and category not in categories:
        raise UsageProblem(f'there is no category {category}; there are {", ".join(categories)}')
    rows = [
        (index, name, prompt)
        for index, (name, prompt) in enumerate(known, start=1)
        if number in (None, index) and category in (None, name)
    ]
    if as_json:
        print_json({'examples': [{'number': i, 'category': c, 'prompt': p} for i, c, p in rows]})
    elif number is not None:
        for _, _, prompt in rows:
            line(answer_console(), prompt)
    else:
        print_table(
            'Examples (aurora examples NUMBER | aurora run - runs one)',
            ('', 'category', 'prompt'),
            [(str(index), name, prompt) for index, name, prompt in rows],
            answer_console(),
            right=(0,),
        )
    return 0

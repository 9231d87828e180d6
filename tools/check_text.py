# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Checks what is written by hand and is no Python: at most 100 columns, word lists sorted."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import yaml

WIDTH = 100
# Figures are written by programs; line breaks of the other two are sent to language models.
FREE = re.compile(r'docs/bench/.*|bench/.*\.md|.*/llm/(instructions|replies)\.yaml')
PARSING = Path('ros_ws/src/aurora_core/aurora_core/parsing')
# Sections of the lexicon that are patterns in an order, or are shown to a model in theirs.
ORDERED = frozenset(
    {'agents', 'ambiguous_agents', 'delivery_words', 'intersection', 'irregular_verbs', 'radio'}
    | {'sides', 'steps', 'time_of_day', 'traffic_words', 'uav', 'units', 'weather', 'width'}
)
_PATTERN = re.compile(r'[()|?*+\[\]\\^$.<]')


def wide_lines(path: Path) -> Iterator[str]:
    """Yield the lines that are too wide; tables and code of a page may be as wide as they need."""
    code = False
    for number, line in enumerate(path.read_text(encoding='utf-8').splitlines(), 1):
        code = code != (path.suffix == '.md' and line.startswith('```'))
        if len(line) > WIDTH and not code and not line.startswith(('|', '`')):
            yield f'{path}:{number}: {len(line)} columns'


def unsorted_lists(node: yaml.Node | None, where: str) -> Iterator[str]:
    """Yield the lists of plain words that are not sorted or say a word twice."""
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            if key.value not in ORDERED:
                yield from unsorted_lists(value, f'{where}: {key.value}')
    elif isinstance(node, yaml.SequenceNode):
        words = [item.value for item in node.value]
        ordered = sorted(set(words), key=lambda word: (word.casefold(), word))
        if words != ordered and not any(map(_PATTERN.search, words)):
            yield f'{where} is not sorted'


def main() -> int:
    """Check every file that git knows."""
    names = subprocess.run(['git', 'ls-files', '*.md', '*.yaml'], capture_output=True, check=True)
    paths = [Path(name) for name in names.stdout.decode().split() if not FREE.fullmatch(name)]
    found = [line for path in paths for line in wide_lines(path)]
    for name in ('lexicon.yaml', 'criteria.yaml'):
        text = (PARSING / name).read_text(encoding='utf-8')
        found += unsorted_lists(yaml.compose(text, yaml.BaseLoader), name)
    rows = [row for row in Path('docs/glossary.md').read_text('utf-8').splitlines() if '|' in row]
    terms = [row.split('|')[1].strip().casefold() for row in rows[2:]]
    found += ['docs/glossary.md is not sorted'] if terms != sorted(terms) else []
    sys.stdout.writelines(f'{line}\n' for line in found)
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())

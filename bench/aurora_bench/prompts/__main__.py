# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.prompts FILE…`: validate prompt files and say what they consist of."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path

from aurora_bench.prompts.figure import draw
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.prompts.paraphrases import check_split
from aurora_bench.prompts.reading import file_text, read_lines
from aurora_bench.prompts.statistics import statistics_tables
from aurora_bench.prompts.validate import validate
from aurora_bench.results import ResultsError, markdown_table


def main(arguments: Sequence[str] | None = None) -> int:
    """Validate; return 1 when there is an error, 64 when a file cannot be read."""
    parser = argparse.ArgumentParser(prog='aurora_bench.prompts', description=__doc__)
    parser.add_argument('files', nargs='+', type=Path, metavar='FILE')
    parser.add_argument('--map', default='downtown', help='whose landmarks count as places')
    parser.add_argument('--json', action='store_true', help='findings as JSON, no tables')
    parser.add_argument('--figure', type=Path, metavar='DIR', help='draw them, into this folder')
    parser.add_argument('--name', default='prompts', help='of the files of the figure')
    options = parser.parse_args(arguments)
    try:
        texts = [file_text(path) for path in options.files]
    except ResultsError as err:
        sys.stderr.write(f'{err}\n')
        return 64
    prompts, findings = validate(texts, options.map)
    parts = [read_lines(text)[0] for text in texts]
    leaks = sorted(
        {
            name
            for k, part in enumerate(parts)
            for other in parts[k + 1 :]
            for name in check_split(part, other)
        }
    )
    errors = sum(finding.is_error for finding in findings) + len(leaks)
    if options.json:
        document = {
            'prompts': len(prompts),
            'errors': errors,
            'groups_in_two_files': leaks,
            'findings': [finding.model_dump(mode='json') for finding in findings],
        }
        sys.stdout.write(json.dumps(document, indent=2) + '\n')
        return int(errors > 0)
    for finding in findings:
        sys.stdout.write(f'{finding}\n')
    for name in leaks:
        sys.stdout.write(f'error: paraphrase group {name} is in two files\n')
    if prompts:
        tables = '\n\n'.join(markdown_table(table) for table in statistics_tables(prompts))
        sys.stdout.write(f'{tables}\n\n')
    if prompts and options.figure is not None:
        try:
            drawn, _ = draw(_by_folder(options.files, parts), options.figure, options.name)
        except ResultsError as err:
            sys.stderr.write(f'{err}\n')
            return 64
        sys.stdout.write(f'see {drawn}\n')
    sys.stdout.write(f'{len(prompts)} prompts, {errors} errors\n')
    return int(errors > 0)


def _by_folder(
    files: Sequence[Path], parts: Sequence[Sequence[AnnotatedPrompt]]
) -> dict[str, list[AnnotatedPrompt]]:
    """Put the prompts of one folder together: folders tell who may look."""
    found: dict[str, list[AnnotatedPrompt]] = {}
    for file, prompts in zip(files, parts, strict=True):
        found.setdefault(file.resolve().parent.name, []).extend(prompts)
    return found


if __name__ == '__main__':
    sys.exit(main())

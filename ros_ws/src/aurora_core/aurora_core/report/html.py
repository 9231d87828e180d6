# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The report as one self-contained page: nothing is loaded from anywhere."""

from __future__ import annotations

import base64
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from aurora_core.compiled import Compiled
from aurora_core.report.clauses import status_word
from aurora_core.report.run_report import RunReport
from aurora_core.report.status import Status
from aurora_core.report.summary import margin_value
from aurora_core.report.visible import visible

if TYPE_CHECKING:
    from jinja2 import Environment, Template

_TEMPLATE = Path(__file__).with_name('report.html.jinja')

# The kind of each status, which decides colour and symbol of the page.
_KINDS = {
    Status.VERIFIED: 'good',
    Status.VERIFIED_AS_EDITED: 'good',
    Status.INCOMPLETE: 'part',
    Status.VIOLATED: 'bad',
    Status.INCONCLUSIVE: 'part',
    Status.INFEASIBLE: 'refused',
    Status.NOT_UNDERSTOOD: 'neutral',
    Status.ERROR: 'bad',
    Status.CANCELLED: 'neutral',
}


def report_html(report: RunReport, picture_png: bytes | None = None) -> str:
    """Return the page.

    Args:
        report: What to show; every text in it is escaped, and what no reader would see is named.
        picture_png: Picture of the run, None when there is none.
    """
    picture = base64.b64encode(picture_png).decode('ascii') if picture_png is not None else ''
    return _template().render(
        report=report,
        status=report.status.value.replace('_', ' '),
        kind=_KINDS[report.status],
        stated=[row for row in report.conditions if row.source],
        safety=[row for row in report.conditions if not row.source],
        picture=picture,
    )


def compiled_page() -> Compiled:
    """Return the code of the page, as set-up compiles it."""
    return Compiled(
        name=_TEMPLATE.name,
        sources=(Path(__file__), _TEMPLATE),
        key=version('jinja2'),
        make=lambda: _environment().compile(
            _TEMPLATE.read_text(encoding='utf-8'), _TEMPLATE.name, str(_TEMPLATE)
        ),
    )


@lru_cache(maxsize=1)
def _template() -> Template:
    # Whoever checks a prompt imports this file; the page comes after the verdict, if at all.
    from jinja2 import Template

    environment = _environment()
    code = compiled_page().value()
    return Template.from_code(environment, code, environment.make_globals(None))


def _environment() -> Environment:
    from jinja2 import Environment, StrictUndefined

    environment = Environment(
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        finalize=_legible,
    )
    environment.filters['number'] = number
    environment.filters['margin_value'] = margin_value
    environment.filters['status_word'] = status_word
    return environment


def _legible(value: object) -> object:
    """Return a text without characters that are obeyed instead of shown; the rest as it is."""
    is_markup = hasattr(value, '__html__')
    return visible(value) if isinstance(value, str) and not is_markup else value


def number(value: float | None, signed: bool = False) -> str:
    """Return a number with four significant digits, a dash for none."""
    if value is None:
        return '–'
    return f'{value:+.4g}' if signed else f'{value:.4g}'

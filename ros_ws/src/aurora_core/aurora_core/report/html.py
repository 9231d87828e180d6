# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The report as one self-contained page: nothing is loaded from anywhere."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from aurora_core.compiled import Compiled
from aurora_core.report.clauses import status_word
from aurora_core.report.mends import could_be
from aurora_core.report.page.repairs import repair_figure
from aurora_core.report.run_report import ClauseReport, RunReport
from aurora_core.report.status import Status
from aurora_core.report.summary import margin_value
from aurora_core.report.visible import visible
from aurora_core.report.why import suspects
from aurora_core.trace.air_clock import paced_lines

if TYPE_CHECKING:
    from jinja2 import Environment, Template

    from aurora_core.report.page.recorded import Recorded

_TEMPLATE = Path(__file__).with_name('report.html.jinja')
_PAGE = Path(__file__).with_name('page')
# In the order in which they use each other.
_SCRIPTS = ('data', 'clock', 'map', 'scene', 'margins', 'graph', 'page')

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


def report_html(
    report: RunReport, picture_png: bytes | None = None, recorded: Recorded | None = None
) -> str:
    """Return the page.

    Args:
        report: What to show; every text in it is escaped, and what no reader would see is named.
        picture_png: Picture of the run, None when there is none.
        recorded: What there is to see of its bag, None when there is none.
    """
    # A check that draws no page does not wait for these.
    from markupsafe import Markup

    picture = base64.b64encode(picture_png).decode('ascii') if picture_png is not None else ''
    parts = _parts()
    return _template().render(
        report=report,
        status=report.status.value.replace('_', ' '),
        kind=_KINDS[report.status],
        pieces=prompt_pieces(report.prompt, report.clauses),
        lost=[clause for clause in report.clauses if clause.status.is_open],
        suspects=suspects(report),
        failed=[row for row in report.conditions if not row.satisfied],
        stated=[row for row in report.conditions if row.source],
        safety=[row for row in report.conditions if not row.source],
        picture=picture,
        recorded=recorded,
        iterations=Markup(repair_figure(report.repairs)),  # nosec
        data=Markup(recorded.data) if recorded is not None else '',  # nosec
        style=Markup(parts.style),  # nosec
        script=Markup(parts.script),  # nosec
        policy=parts.policy,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Piece:
    """A piece of the prompt; `status` is '' where no clause is."""

    text: str
    status: str = ''
    title: str = ''


def prompt_pieces(prompt: str, clauses: Sequence[ClauseReport]) -> tuple[Piece, ...]:
    """Return the prompt in pieces; of clauses that overlap, an open one comes first."""
    owner: list[ClauseReport | None] = [None] * len(prompt)
    # A clause about the whole prompt stands for none of its words.
    for clause in sorted(clauses, key=lambda c: c.status.is_open):
        if clause.span.end - clause.span.start < len(prompt) or len(clauses) == 1:
            for k in range(clause.span.start, min(clause.span.end, len(prompt))):
                owner[k] = clause
    pieces: list[Piece] = []
    start = 0
    for k in range(1, len(prompt) + 1):
        if k == len(prompt) or owner[k] is not owner[start]:
            pieces.append(_piece(prompt[start:k], owner[start], clauses))
            start = k
    return tuple(pieces)


def _piece(text: str, clause: ClauseReport | None, clauses: Sequence[ClauseReport]) -> Piece:
    if clause is None:
        return Piece(text=text)
    note = f': {clause.note}' if clause.note else ''
    return Piece(
        text=text, status=clause.status.value, title=f'{status_word(clause, clauses)}{note}'
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Parts:
    """What every page holds; the policy lets a browser use nothing but these, and no network."""

    style: str
    script: str
    policy: str


@lru_cache(maxsize=1)
def _parts() -> _Parts:
    style = (_PAGE / 'page.css').read_text(encoding='utf-8')
    scripts = [(_PAGE / f'{name}.js').read_text(encoding='utf-8') for name in _SCRIPTS]
    script = '\n'.join(['(() => {', "'use strict';", *scripts, '})();'])
    policy = (
        f"default-src 'none'; img-src data:; style-src '{_hash(style)}'; "
        f"script-src '{_hash(script)}'; base-uri 'none'; form-action 'none'"
    )
    return _Parts(style=style, script=script, policy=policy)


def _hash(text: str) -> str:
    digest = hashlib.sha256(text.encode('utf-8')).digest()
    return f'sha256-{base64.b64encode(digest).decode("ascii")}'


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
    environment.filters['could_be'] = could_be
    environment.filters['number'] = number
    environment.filters['paced_lines'] = paced_lines
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

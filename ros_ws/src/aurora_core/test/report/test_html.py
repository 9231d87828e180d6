# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from html.parser import HTMLParser
from types import SimpleNamespace

import pytest

from aurora_core.errors import ExecutionError
from aurora_core.execution.faults import Fault
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.parse import ParseOutcome, Refusal, RefusalKind
from aurora_core.report.build import build_report
from aurora_core.report.html import number, report_html
from aurora_core.spec.parameter import Span


class _Balance(HTMLParser):
    """Finds tags that are closed in the wrong order."""

    void = frozenset({'meta', 'img', 'br', 'link', 'hr', 'wbr'})

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.sources: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in self.void:
            self.open.append(tag)
        found = [value or '' for name, value in attrs if name in ('src', 'href')]
        # Within the page one may go wherever one likes.
        self.sources += [value for value in found if not value.startswith('#')]

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def _parsed(page: str) -> _Balance:
    parser = _Balance()
    parser.feed(page)
    parser.close()
    assert parser.open == []
    return parser


def test_the_page_is_whole_and_loads_nothing(make: SimpleNamespace) -> None:
    page = report_html(build_report(make.facts()), b'\x89PNG')
    sources = _parsed(page).sources
    assert sources == ['data:image/png;base64,iVBORw==']
    assert not re.search(r'https?://', page)
    assert 'width=device-width' in page


@pytest.mark.parametrize('text', ['<script>alert(1)</script>', '"><img src=x onerror=y>', "'&"])
def test_texts_of_the_prompt_cannot_become_markup(make: SimpleNamespace, text: str) -> None:
    facts = make.facts(prompt=text, verdict=make.verdict(make.result(explanation=text)))
    page = report_html(build_report(facts))
    assert text not in page
    assert _parsed(page).sources == []


def test_each_kind_of_end_is_told(make: SimpleNamespace) -> None:
    nothing = {'grounding': None, 'execution': None, 'verdict': None}
    asked = build_report(make.facts(parse=ParseOutcome(question='Which car?'), **nothing))
    assert 'Which car?' in report_html(asked)
    refusal = Refusal(
        kind=RefusalKind.UNSUPPORTED,
        word='tank',
        span=Span(start=2, end=7),
        list_name='agent types',
        closed_list=('car',),
    )
    refused = build_report(make.facts(parse=ParseOutcome(refusals=(refusal,)), **nothing))
    page = report_html(refused)
    assert 'Why it is refused' in page
    assert make.prompt[2:7] in page
    err = ExecutionError('it stopped', hint='look there')
    broken = report_html(build_report(make.facts(error=err)))
    assert 'it stopped' in broken
    assert 'look there' in broken
    fault = Fault(kind='link_loss', subject='*', value=1.0)
    assert 'Injected faults' in report_html(build_report(make.facts(faults=(fault,))))
    grounding = GroundingOutcome(agsg=make.graph(), unsupported=('m1: overtaking',))
    assert 'overtaking' in report_html(build_report(make.facts(grounding=grounding)))


def test_a_condition_without_a_margin_says_why(make: SimpleNamespace) -> None:
    facts = make.facts(verdict=make.verdict(make.result(margin=None)))
    assert 'that phase never began' in report_html(build_report(facts))


@pytest.mark.parametrize(
    ('value', 'signed', 'text'),
    [(None, False, '–'), (1.0 / 3.0, False, '0.3333'), (0.25, True, '+0.25')],
)
def test_numbers_have_four_digits(value: float | None, signed: bool, text: str) -> None:
    assert number(value, signed) == text


def test_what_no_reader_would_see_is_named(make: SimpleNamespace) -> None:
    text = 'A drone \x1b[31mhovers\x07 \u202eover\u2066 the ego.'
    page = report_html(build_report(make.facts(prompt=text)))
    assert not any(character in page for character in '\x1b\x07\u202e\u2066')
    assert r'\x1b[31mhovers\x07 \u202eover\u2066' in page

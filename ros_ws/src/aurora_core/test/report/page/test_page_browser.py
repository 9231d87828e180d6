# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
import shutil
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, sync_playwright

from aurora_core.judging.build import Source, Target, condition
from aurora_core.judging.quantities.altitude import Altitude
from aurora_core.outcomes.condition import Window
from aurora_core.outcomes.verdict import Verdict
from aurora_core.report.build import build_report
from aurora_core.report.html import report_html
from aurora_core.report.page.recorded import recorded
from aurora_core.trace.bag_content import BagContent
from aurora_core.trace.records import LinkEventKind, LinkRecord, LossReason, SightRecord

_NAMES = ('chromium', 'chromium-browser', 'google-chrome', 'chrome')
_QUIET = ('no-sandbox', 'disable-gpu', 'disable-quic', 'no-first-run')
_OFFLINE = ('disable-background-networking', 'disable-component-update', 'disable-sync')
_EVIL = '</script><img src=x onerror="window.hit=1"><svg onload="window.hit=1">'

# How many pixels of the map have a colour.
COUNT = """([r, g, b]) => { const map = document.getElementById('map');
  const all = map.getContext('2d').getImageData(0, 0, map.width, map.height).data;
  let found = 0;
  for (let k = 0; k < all.length; k += 4) {
    if (all[k] === r && all[k + 1] === g && all[k + 2] === b) found += 1;
  }
  return found; }"""

Open = Callable[..., Page]


@pytest.fixture(scope='module')
def browser() -> Iterator[Browser]:
    """A browser of the system; who has none skips these tests."""
    path = next((found for name in _NAMES if (found := shutil.which(name))), None)
    if path is None:
        pytest.skip('no Chromium on this machine (Debian: apt install chromium)')
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(
            executable_path=path, args=[f'--{option}' for option in (*_QUIET, *_OFFLINE)]
        )
        yield started
        started.close()


def _trace(make: SimpleNamespace, *, lost: bool = False) -> Any:
    def entry(k: int, tick: int, kind: LinkEventKind) -> LinkRecord:
        return LinkRecord(
            tick=tick, sequence=k, message=1, link='link1', event='e1', sender='uav1',
            receiver='motorcycle1', kind=kind, attempt=1, reason=LossReason.NONE,
            distance_m=30.0, line_of_sight=True,
        )  # fmt: skip

    tried = LinkEventKind.ATTEMPT_LOST if lost else LinkEventKind.ATTEMPT_PASSED
    kinds = (LinkEventKind.SENT, tried, LinkEventKind.DELIVERED)
    links = tuple(entry(k, 160 + k, kind) for k, kind in enumerate(kinds))
    sights = tuple(
        SightRecord(
            tick=tick, observer='uav1', target='motorcycle1', visible=seen, slant_range_m=40.0
        )
        for tick, seen in ((0, False), (140, True), (300, False))
    )
    return replace(make.trace(), links=links, sights=sights)


def _page(
    make: SimpleNamespace, verdict: Verdict, prompt: str | None = None, *, lost: bool = False
) -> str:
    limit = condition(
        id='m1.visible',
        sentence='uav1 flies at most 30 m high',
        of=('uav1', 'motorcycle1'),
        target=Target(op='<=', threshold=30.0, unit='m'),
        arguments=Altitude(horizon_s=19.0, window=Window.RUN, touchdown_m=0.3),
        source=Source(ids=('m1',)),
    )
    content = BagContent(trace=_trace(make, lost=lost), world=make.world(limit), agsg_message=None)
    changes: dict[str, Any] = {'verdict': verdict}
    if prompt is not None:
        changes['prompt'] = prompt
    report = build_report(make.facts(**changes))
    return report_html(report, None, recorded(report, content, make.graph()))


@pytest.fixture
def opened(browser: Browser, make: SimpleNamespace, tmp_path: Path) -> Iterator[Open]:
    """Opens the page of a run; no script may fail, nothing may be asked of a network."""
    pages: list[Page] = []
    wrong: list[str] = []

    def ask(
        text: str = '', verdict: Verdict | None = None, *, lost: bool = False, **look: Any
    ) -> Page:
        path = tmp_path / 'report.html'
        failed = make.verdict(make.result(margin=-0.2, satisfied=False))
        page_text = _page(make, verdict or failed, text or None, lost=lost)
        path.write_text(page_text, encoding='utf-8')
        page = browser.new_context(**look).new_page()
        page.set_default_timeout(10_000)
        page.on('pageerror', lambda error: wrong.append(str(error)))
        page.on('console', lambda told: wrong.append(told.text) if told.type == 'error' else None)
        page.on('request', lambda asked: wrong.append(asked.url) if pages else None)
        page.goto(path.as_uri())
        pages.append(page)
        return page

    yield ask
    for page in pages:
        page.context.close()
    assert wrong == []


def _time(page: Page) -> float:
    shown = re.match(r'[\d.]+', page.locator('#time').inner_text())
    assert shown is not None
    return float(shown[0])


def _until(holds: Callable[[], bool]) -> None:
    """Wait for something; the page's policy forbids to evaluate a text in it again and again."""
    end = time.monotonic() + 20.0
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.02)


def _seen(page: Page) -> str:
    return str(page.evaluate("document.getElementById('map').toDataURL()"))


def test_it_plays_pauses_and_goes_faster(opened: Open, make: SimpleNamespace) -> None:
    page = opened(verdict=make.verdict())
    assert _time(page) == 0.0
    before = _seen(page)
    page.select_option('#speed', '10')
    page.click('#play')
    _until(lambda: _time(page) > 8.0)
    page.click('#play')
    paused = _time(page)
    assert _seen(page) != before
    page.wait_for_timeout(300)
    assert _time(page) == paused
    # From the end it begins again.
    page.locator('#scrub').press('End')
    assert _time(page) == pytest.approx(19.9, abs=0.1)
    page.click('#play')
    _until(lambda: _time(page) < 8.0)


def test_scrubbing_moves_map_table_list_and_charts_together(opened: Open) -> None:
    page = opened()
    before = _seen(page)
    page.locator('#scrub').fill('9')
    assert _time(page) == 9.0
    assert _seen(page) != before
    assert 'mission' in page.locator('#bodies tr', has_text='uav1').inner_text()
    assert 'message delivered' in page.locator('.happened .now').inner_text()
    chart = page.locator('.fails .chart').first
    assert 'at 9.0 s' in chart.inner_text()
    head = chart.locator('.head').get_attribute('x1')
    page.locator('#scrub').fill('11')
    assert chart.locator('.head').get_attribute('x1') != head


def test_a_click_into_a_chart_or_on_a_moment_sets_the_clock(opened: Open) -> None:
    page = opened()
    page.locator('.happened button', has_text='message').click()
    assert _time(page) == 8.0
    chart = page.locator('.fails .chart svg').first
    box = chart.bounding_box()
    assert box is not None
    chart.click(position={'x': box['width'] * 0.5, 'y': 30})
    assert 8.0 < _time(page) < 12.0
    page.locator('td.at .seek').first.click()
    assert _time(page) == 12.5


def test_everything_goes_by_keyboard(opened: Open, make: SimpleNamespace) -> None:
    page = opened(verdict=make.verdict())
    page.keyboard.press('ArrowRight')
    page.keyboard.press('ArrowRight')
    assert _time(page) == 2.0
    page.keyboard.press(']')
    after = _time(page)
    assert after > 2.0
    page.keyboard.press('[')
    assert _time(page) < after
    page.keyboard.press(' ')
    _until(lambda: page.locator('#play').get_attribute('aria-label') == 'Pause')
    page.keyboard.press(' ')
    page.locator('#scrub').press('Home')
    assert _time(page) == 0.0
    reached = set()
    for _ in range(60):
        page.keyboard.press('Tab')
        reached.add(page.evaluate('document.activeElement.id'))
    assert {'map', 'play', 'scrub', 'speed', 'follow'} <= reached


def test_a_failed_condition_lights_up_what_it_depends_on(opened: Open) -> None:
    page = opened()
    assert _time(page) == 12.5
    lit = page.locator('.node.lit')
    assert {'uav1', 'motorcycle1'} <= {
        lit.nth(k).get_attribute('data-node') for k in range(lit.count())
    }
    assert 'failed' in (page.locator('#paper').get_attribute('class') or '')
    assert 'missions/m1/altitude_m' in page.locator('#depends').inner_text()
    page.locator('.node', has_text='motorcycle1').press('Enter')
    assert 'conditions depend on it' in page.locator('#depends').inner_text()
    assert page.locator('.chips .touched').count() == 1


def test_sight_and_messages_are_drawn_while_they_happen(opened: Open) -> None:
    page = opened()
    # The ledger tells the same as the map.
    assert 'delivered' in page.locator('#messages tbody').inner_text()

    def purple() -> int:
        return int(page.evaluate(COUNT, [154, 92, 192]))

    page.locator('#scrub').fill('8.5')
    assert purple() > 20
    page.locator('#scrub').fill('14')
    assert purple() == 0


def test_what_failed_stands_first_with_its_chart(opened: Open) -> None:
    page = opened(viewport={'width': 1600, 'height': 900})
    failed = page.locator('#failed')
    assert 'What failed (1 of 1)' in failed.inner_text()
    assert failed.locator('.chart svg').count() == 1
    assert failed.locator('.instead').inner_text() == 'seen in 90 % of the samples'
    box = failed.bounding_box()
    # Beside the map, in the first screen.
    assert box is not None
    assert box['y'] < 450
    assert page.locator('#asked table').count() == 0
    page.locator('nav a', has_text='what failed').click()
    assert page.evaluate('location.hash') == '#failed'


def test_a_lost_attempt_is_told_on_the_map(opened: Open) -> None:
    page = opened(lost=True)

    def red() -> int:
        return int(page.evaluate(COUNT, [181, 27, 27]))

    page.locator('#scrub').fill('7.9')
    before = red()
    page.locator('#scrub').fill('8.5')
    assert red() > before + 20


def test_markup_in_a_prompt_stays_text(opened: Open) -> None:
    page = opened(f'A drone {_EVIL} follows a motorcycle at 40 meters.')
    assert page.evaluate('window.hit') is None
    assert page.locator('img').count() == 0
    assert _EVIL in page.locator('h1').inner_text()


@pytest.mark.parametrize('width', [400, 1600])
@pytest.mark.parametrize('scheme', ['light', 'dark'])
def test_it_fits_narrow_and_wide_by_day_and_night(opened: Open, width: int, scheme: str) -> None:
    page = opened(viewport={'width': width, 'height': 900}, color_scheme=scheme)
    assert page.evaluate('document.documentElement.scrollWidth') <= width
    box = page.locator('#map').bounding_box()
    assert box is not None
    assert box['width'] > 0.4 * width
    light = page.evaluate(
        """() => { const of = (name) => getComputedStyle(document.body)[name].match(/\\d+/g)
          .slice(0, 3).reduce((sum, part) => sum + Number(part), 0);
          return [of('color'), of('backgroundColor')]; }"""
    )
    assert (light[0] > light[1] + 300) == (scheme == 'dark')
    assert abs(light[0] - light[1]) > 300


def test_it_prints_in_black_on_white(opened: Open) -> None:
    page = opened(color_scheme='dark')
    page.emulate_media(media='print')
    page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    assert page.locator('.transport').is_hidden()
    assert page.locator('.fails details').first.get_attribute('open') is not None
    corner = page.evaluate(
        """() => [...document.getElementById('map').getContext('2d').getImageData(2, 2, 1, 1)
          .data].slice(0, 3)"""
    )
    assert min(corner) > 200
    # The map is not pulled out of its shape.
    shape = page.evaluate(
        """() => { const map = document.getElementById('map');
          return [map.width / map.height, map.clientWidth / map.clientHeight]; }"""
    )
    assert shape[0] == pytest.approx(shape[1], rel=0.02)
    assert page.pdf().startswith(b'%PDF')


def test_names_stay_whole_on_a_narrow_screen(opened: Open) -> None:
    """No name is broken in two; a path breaks behind its slashes alone."""
    page = opened(viewport={'width': 400, 'height': 900})
    lines = """cells => cells.map(cell => {
        const range = document.createRange();
        range.selectNodeContents(cell);
        return [cell.textContent, new Set([...range.getClientRects()].map(r => r.top)).size];
    })"""
    names = page.locator('#understood td > code').evaluate_all(lines)
    assert 'motorcycle1' in [text for text, _ in names]
    assert all(count == 1 for _, count in names), names
    paths = page.locator('#realised td > code').evaluate_all(lines)
    assert paths
    assert all(count <= text.count('/') + 1 for text, count in paths), paths
    apart = """cells => cells.map(cell => {
        const name = document.createRange();
        name.selectNodeContents(cell.lastChild);
        const colour = cell.firstChild.getBoundingClientRect();
        return Math.abs(name.getBoundingClientRect().top - colour.top);
    })"""
    bodies = page.locator('#bodies td:first-child').evaluate_all(apart)
    assert bodies
    assert max(bodies) < 10, 'a body and its colour stand in different lines'

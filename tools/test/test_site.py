# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The documentation as a site: it builds strictly, loads nothing from elsewhere, leaves no gap."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from site_pages import captions, vocabulary_entries

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope='module')
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp('site')
    done = subprocess.run(
        [sys.executable, '-m', 'mkdocs', 'build', '--strict', '-d', str(folder)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=250,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


def test_every_page_of_docs_is_in_the_site(site: Path) -> None:
    for page in (ROOT / 'docs').rglob('*.md'):
        where = page.relative_to(ROOT / 'docs').with_suffix('')
        name = 'index' if where.name == 'README' else where.name
        assert (site / where.parent / f'{name}.html').is_file(), page


def test_links_lead_to_pages(site: Path) -> None:
    for page in site.rglob('*.html'):
        text = page.read_text(encoding='utf-8')
        for target in re.findall(r'<a [^>]*href="([^"#]+)', text):
            if not re.match(r'\w+:|/', target) and page.name != '404.html':
                assert (page.parent / target).exists(), f'{page}: {target}'


def test_a_browser_loads_nothing_from_elsewhere(site: Path) -> None:
    loaded = re.compile(r'<(?:script|img|link|iframe)[^>]*(?:src|href)="?(https?:[^" >]*)')
    for page in site.rglob('*.html'):
        found = loaded.findall(page.read_text(encoding='utf-8'))
        assert [url for url in found if 'canonical' not in url] == [], page


def test_the_reference_has_every_interface(site: Path) -> None:
    text = (site / 'ros_reference.html').read_text(encoding='utf-8')
    for kind in ('msg', 'srv', 'action'):
        for path in (ROOT / 'aurora_msgs' / kind).iterdir():
            assert f'id="{path.stem.lower()}"' in text, path
    assert 'last tick stored' in text


def test_every_word_of_the_vocabulary_has_its_picture(site: Path) -> None:
    text = (site / 'vocabulary.html').read_text(encoding='utf-8')
    entries = list(vocabulary_entries())
    assert len(entries) > 20
    told = captions()
    for entry in entries:
        # Missing: python tools/vocabulary_pictures.py draws it.
        assert (site / 'images' / 'vocabulary' / entry.image).is_file(), entry.prompt
        assert f'images/vocabulary/{entry.image}' in text
        assert told[entry.image]
    pictures = (ROOT / 'docs' / 'images' / 'vocabulary').glob('*.png')
    assert {path.name for path in pictures} == {entry.image for entry in entries}


def test_the_quick_start_is_the_readme(site: Path) -> None:
    text = (site / 'index.html').read_text(encoding='utf-8')
    assert 'aurora run' in text
    assert 'images/tailgate.png' in text
    assert 'docs/' not in re.sub(r'<code>.*?</code>', '', text, flags=re.DOTALL)

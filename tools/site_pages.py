# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Pages of the site that are made from what exists: the quick start and the ROS reference.

MkDocs calls the functions by their names (`hooks` in mkdocs.yml).
"""

from __future__ import annotations

import hashlib
import html
import posixpath
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import yaml
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).resolve().parents[1]
VOCABULARY_IMAGES = ROOT / 'docs' / 'images' / 'vocabulary'
VOCABULARY_CAPTIONS = ROOT / 'docs' / 'images' / 'vocabulary' / 'captions.yaml'
_KINDS = {'msg': 'Messages', 'srv': 'Services', 'action': 'Actions'}


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the generated pages."""
    made = {
        'index.md': quick_start(),
        'ros_reference.md': ros_reference(),
        'vocabulary.md': vocabulary(),
    }
    for name, content in made.items():
        files.append(File.generated(config, name, content=content))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Take the links off that lead out of the site; what they are on stays to be read."""

    def kept(found: re.Match[str]) -> str:
        target = found[2].partition('#')[0]
        if not target or re.match(r'\w+:', target):
            return found[0]
        where = posixpath.normpath(posixpath.join(posixpath.dirname(page.file.src_uri), target))
        # What is nowhere keeps its link, and fails the build.
        outside = any((root / where).exists() for root in (ROOT, ROOT / 'docs'))
        return found[1] if outside and files.get_file_from_path(where) is None else found[0]

    return re.sub(r'(?<!!)\[([^\[\]]*)\]\(([^)\s]*)\)', kept, markdown)


def quick_start() -> str:
    """Return the README with its links as seen from `docs/`; its commands run in the tests."""
    text = (ROOT / 'README.md').read_text(encoding='utf-8')
    inside = re.sub(r'\]\(docs/([^)]*)\)', r'](\1)', text)
    return re.sub(r'\[docs/(\w+)\.md\]', r'[\1]', inside)


class Entry(NamedTuple):
    """Words of the vocabulary, a prompt with them, and the name of its picture."""

    group: str
    words: str
    prompt: str

    @property
    def image(self) -> str:
        """File name: another prompt has another picture."""
        words = re.sub(r'[^a-z]+', '_', self.words.lower()).strip('_')
        return f'{words}_{hashlib.sha256(self.prompt.encode()).hexdigest()[:8]}.png'


def vocabulary_entries() -> Iterator[Entry]:
    """Yield what `docs/vocabulary.yaml` lists."""
    text = (ROOT / 'docs' / 'vocabulary.yaml').read_text(encoding='utf-8')
    for group, entries in yaml.safe_load(text).items():
        for words, prompt in entries.items():
            yield Entry(group, words, prompt)


def captions() -> dict[str, list[str]]:
    """Return what the numbers of each picture stand for, by its name."""
    if not VOCABULARY_CAPTIONS.exists():
        return {}
    return dict(yaml.safe_load(VOCABULARY_CAPTIONS.read_text(encoding='utf-8')) or {})


def vocabulary() -> str:
    """Return a page with a picture for each entry of the vocabulary."""
    parts = [
        '# The vocabulary in pictures\n',
        'Each prompt is verified on the bundled map; its picture is the run as '
        '`aurora picture --style paper` draws it. Triangles are drones, circles are who is on '
        'the ground; the numbers are what happens, in order. '
        'Every word, with what it means on the map: [what is understood](understood.md).\n',
    ]
    group, told = '', captions()
    for entry in vocabulary_entries():
        if entry.group != group:
            group = entry.group
            parts.append(f'## {group}\n')
        parts.append(f'### *{entry.words}*\n\n```text\n{entry.prompt}\n```\n')
        parts.append(f'![{entry.prompt}](images/vocabulary/{entry.image}){{ width="420" }}\n')
        lines = ' · '.join(' '.join(line.split()) for line in told.get(entry.image, ()))
        parts.append(f'<small>{html.escape(lines)}</small>\n')
    return '\n'.join(parts)


def ros_reference() -> str:
    """Return a page with every message, service and action, as the interface files have them."""
    parts = [
        '# Messages, services, actions\n',
        'Made from the files in `aurora_msgs`. Topics with QoS, unit and frame: '
        '[interfaces](interfaces.md).\n',
    ]
    for kind, title in _KINDS.items():
        parts.append(f'## {title}\n')
        for path in sorted((ROOT / 'aurora_msgs' / kind).glob(f'*.{kind}')):
            lines = path.read_text(encoding='utf-8').splitlines()
            lines = [line for line in lines if not line.startswith('# SPDX-')]
            about = []
            while lines and lines[0].startswith('#'):
                about.append(lines.pop(0).lstrip('# '))
            body = '\n'.join(lines).strip('\n')
            parts.append(f'### {path.stem}\n')
            if about:
                parts.append('\n'.join(about) + '\n')
            parts.append(f'```text\n{body}\n```\n')
    return '\n'.join(parts)

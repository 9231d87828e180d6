# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Draw the pictures of the page "The vocabulary in pictures" that are not there yet.

    tools/in_env.sh python tools/vocabulary_pictures.py

Each prompt of `docs/vocabulary.yaml` is run; one that is not verified gets no picture, and the
exit code is 1. A picture's name holds a digest of its prompt: another prompt, another picture.
"""

from __future__ import annotations

import io
import sys
import tempfile
from pathlib import Path

import yaml
from PIL import Image

import aurora
from aurora_core.pipeline.verification import load_bag
from aurora_core.report.picture.paper import draw_paper, moment_lines, paper_bytes
from aurora_core.report.scene.caption import Caption
from aurora_core.report.status import Status
from site_pages import VOCABULARY_CAPTIONS, VOCABULARY_IMAGES, captions, vocabulary_entries

_WIDTH_PX = 760
# Few colours make small files; a figure for print has few.
_COLOURS = 96


def main() -> int:
    """Draw what is missing, remove what no prompt needs; return the exit code."""
    entries = list(vocabulary_entries())
    VOCABULARY_IMAGES.mkdir(parents=True, exist_ok=True)
    for old in VOCABULARY_IMAGES.glob('*.png'):
        if old.name not in {entry.image for entry in entries}:
            old.unlink()
    failed = 0
    known = captions()
    told = {entry.image: known[entry.image] for entry in entries if entry.image in known}
    for entry in entries:
        path = VOCABULARY_IMAGES / entry.image
        if path.exists() and entry.image in told:
            continue
        with tempfile.TemporaryDirectory() as folder:
            run = aurora.run(entry.prompt, out=Path(folder))
            if run.status is not Status.VERIFIED:
                failed += 1
                sys.stderr.write(f'{run.status.value}: {entry.prompt}\n{run.report.summary}\n')
                continue
            content, agsg = load_bag(run.folder / 'bag.0')
        caption = Caption.of_report(run.report)
        figure = draw_paper(content.trace, content.world, caption, spec=agsg.spec)
        path.write_bytes(_small(paper_bytes(figure, '.png')))
        told[entry.image] = list(moment_lines(content.trace, content.world, caption, agsg.spec))
        VOCABULARY_CAPTIONS.write_text(yaml.safe_dump(told, width=99), encoding='utf-8')
        sys.stderr.write(f'{path.name}: {entry.words}\n')
    return 1 if failed else 0


def _small(png: bytes) -> bytes:
    picture = Image.open(io.BytesIO(png)).convert('RGB')
    size = (_WIDTH_PX, round(picture.height * _WIDTH_PX / picture.width))
    stream = io.BytesIO()
    picture.resize(size, Image.Resampling.LANCZOS).quantize(_COLOURS).save(
        stream, 'PNG', optimize=True
    )
    return stream.getvalue()


if __name__ == '__main__':
    sys.exit(main())

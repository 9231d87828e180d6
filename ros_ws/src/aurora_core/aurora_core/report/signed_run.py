# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Signed runs: the digests of every file of a run folder under one signature.

Digests in a run folder show damage. Who rewrites bag, report and digests in agreement is found
only by a signature, since that takes a key which is not in the folder. `signed.json` holds the
digests, `signed.sig` the Ed25519 signature of its bytes; any tool can check both.
"""

from __future__ import annotations

import base64
import binascii
import hashlib
import os
import stat
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Literal

from pydantic import Field, ValidationError

from aurora_core.document import Document, first_problem
from aurora_core.errors import ReportError
from aurora_core.files import BAG_BYTES, DOCUMENT_BYTES, open_regular, read_bytes
from aurora_core.report.doubts import Doubt, altered, unknown
from aurora_core.report.run_documents import Unreadable, read_document
from aurora_core.report.run_folder import (
    MANIFEST,
    REPORT,
    SIGNATURE,
    SIGNED,
    RunFolder,
    is_part_of_run,
)
from aurora_core.report.run_report import RunReport

# Gives the name of the trusted key that signed a message, None when none of them did.
Verifier = Callable[[bytes, bytes], str | None]
# Gives the signature of a message.
Signer = Callable[[bytes], bytes]

_SIGNATURE_BYTES = 1024
_PIECE_BYTES = 1 << 20
# A run has some twenty files, and ten for each repair.
_MOST_FILES = 10_000
_SHOWN = 3


class SignedFile(Document):
    """One file of a signed run.

    Attributes:
        name: Path in the run folder, parts separated by `/`.
        size: Bytes.
        sha256: Hex.
    """

    name: str
    size: int = Field(ge=0)
    sha256: str = Field(pattern=r'^[0-9a-f]{64}$')


class SignedRun(Document):
    """What is signed (`signed.json`).

    Attributes:
        kind: Tells the document from anything else that the same key may sign.
        run_id: Of the run.
        status: That its report ends with.
        files: Every file of the folder, sorted by name.
    """

    kind: Literal['aurora signed run'] = 'aurora signed run'
    schema_version: Literal[1] = 1
    run_id: str
    status: str
    files: tuple[SignedFile, ...]


class SignatureCheck(Document):
    """What `aurora verify --trusted` found out about the signature of a run.

    Attributes:
        key: Fingerprint of the trusted key that signed, '' when none did.
        files: How many files are as they were signed.
        unsigned: Files that were added and are no part of a run.
        doubts: Why the run is not the one that was signed; none when it is.
    """

    key: str = ''
    files: int = 0
    unsigned: tuple[str, ...] = ()
    doubts: tuple[Doubt, ...] = ()


def sign_run(run: Path, signer: Signer) -> SignedRun:
    """Sign every file of a finished run; a signature that is there is replaced.

    Args:
        run: Run folder, under the name that its run gave it.
        signer: Holds the key.

    Raises:
        ReportError: It is no finished run, holds a link or a device, or cannot be written.
    """
    report = read_document(run / REPORT, RunReport)
    if isinstance(report, Unreadable):
        raise ReportError(
            f'{run} cannot be signed: {report.why}', hint='only a finished run is signed'
        )
    if not (run / MANIFEST).exists():
        raise ReportError(f'{run} cannot be signed: {MANIFEST} is missing')
    folder = RunFolder(run.absolute().parent, run.absolute().name)
    if report.run_id != folder.run_id:
        raise ReportError(f'{REPORT} in {run} is of another run, {report.run_id}')
    try:
        files = tuple(_digest(run, name) for name in sorted(_names(run)))
    except OSError as err:
        raise ReportError(f'{run} cannot be signed: {err.strerror or err}') from err
    signed = SignedRun(run_id=report.run_id, status=report.status.value, files=files)
    text = signed.canonical_json() + '\n'
    signature = base64.b64encode(signer(text.encode('utf-8')))
    folder.write_text(SIGNED, text)
    folder.write_bytes(SIGNATURE, signature + b'\n')
    return signed


def check_signature(run: Path | None, verifier: Verifier) -> SignatureCheck:
    """Tell whether a run folder is, file by file, what a trusted key signed.

    Args:
        run: Run folder, None for a bag that lies alone.
        verifier: Knows the trusted keys.
    """
    if run is None:
        return _doubt(unknown('a bag without its run folder is not signed'))
    try:
        text = read_bytes(run / SIGNED, DOCUMENT_BYTES)
        signature = base64.b64decode(
            read_bytes(run / SIGNATURE, _SIGNATURE_BYTES).strip(), validate=True
        )
    except FileNotFoundError as err:
        return _doubt(unknown(f'it is not signed: {Path(str(err.filename)).name} is missing'))
    except (OSError, binascii.Error) as err:
        return _doubt(unknown(f'its signature cannot be read: {err}'))
    key = verifier(text, signature)
    if key is None:
        return _doubt(altered(f'no trusted key signed its {SIGNED}'))
    try:
        return _held(run, key, SignedRun.model_validate_json(text))
    except ValidationError as err:
        return _doubt(unknown(f'{SIGNED} is not what `aurora sign` writes: {first_problem(err)}'))


def _held(run: Path, key: str, signed: SignedRun) -> SignatureCheck:
    """Compare a folder with what was signed of it."""
    then = {entry.name: entry for entry in signed.files}
    try:
        now = set(_names(run))
    except OSError as err:
        return _doubt(unknown(f'it cannot be compared with its signature: {err.strerror or err}'))
    changed = []
    for name in sorted(then.keys() & now):
        try:
            if _digest(run, name) != then[name]:
                changed.append(name)
        except OSError:
            changed.append(name)
    folders = {name.partition('/')[0] for name in then if '/' in name}
    added = sorted(now - then.keys())
    ours = [name for name in added if _is_ours(name, folders)]
    found = (
        ('changed since it was signed', changed),
        ('missing since it was signed', sorted(then.keys() - now)),
        ('added since it was signed', ours),
    )
    return SignatureCheck(
        key=key,
        files=len(then.keys() & now) - len(changed),
        unsigned=tuple(name for name in added if name not in ours),
        doubts=tuple(altered(f'{what}: {_some(names)}') for what, names in found if names),
    )


def _is_ours(name: str, folders: set[str]) -> bool:
    """Tell whether a name is one that a verdict or a reader of the run may go by."""
    first = name.partition('/')[0]
    return is_part_of_run(first) or first in folders


def _names(run: Path) -> Iterator[str]:
    """Yield the path of every file in a run folder but the signature's own.

    Raises:
        OSError: A folder cannot be read, or there is a link, a device, or far too many files.
    """
    waiting, count = [''], 0
    while waiting:
        inside = waiting.pop()
        with os.scandir(run / inside) as entries:
            for entry in entries:
                # Bytes that are no text are shown; no file has the shown name, so none is signed.
                name = f'{inside}{entry.name}'.encode('utf-8', 'backslashreplace').decode()
                mode = entry.stat(follow_symlinks=False).st_mode
                count += 1
                if count > _MOST_FILES:
                    raise OSError(f'it holds more than {_MOST_FILES} files')
                if stat.S_ISDIR(mode):
                    waiting.append(f'{name}/')
                elif not stat.S_ISREG(mode):
                    raise OSError(f'{name} is a link, a pipe or a device')
                elif name not in (SIGNED, SIGNATURE):
                    yield name


def _digest(run: Path, name: str) -> SignedFile:
    digest, size = hashlib.sha256(), 0
    with open_regular(run / name, BAG_BYTES) as stream:
        while piece := stream.read(_PIECE_BYTES):
            digest.update(piece)
            size += len(piece)
    return SignedFile(name=name, size=size, sha256=digest.hexdigest())


def _doubt(doubt: Doubt) -> SignatureCheck:
    return SignatureCheck(doubts=(doubt,))


def _some(names: Sequence[str]) -> str:
    more = f' and {len(names) - _SHOWN} more' if len(names) > _SHOWN else ''
    return ', '.join(names[:_SHOWN]) + more

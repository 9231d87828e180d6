# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ed25519 keys of the user: private ones that sign runs, public ones that are trusted.

The only module that imports `cryptography`. Keys are files in the formats that others write:
OpenSSH (`ssh-keygen -t ed25519`) and PEM (`openssl genpkey -algorithm ed25519`).
"""

from __future__ import annotations

import base64
import getpass
import hashlib
import os
import stat
import sys
from datetime import datetime
from pathlib import Path

from cryptography.exceptions import InvalidSignature, UnsupportedAlgorithm
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey, Ed25519PublicKey
from cryptography.hazmat.primitives.asymmetric.types import PublicKeyTypes
from cryptography.hazmat.primitives.serialization import (
    Encoding,
    NoEncryption,
    PrivateFormat,
    PublicFormat,
    SSHPublicKeyTypes,
    load_pem_private_key,
    load_pem_public_key,
    load_ssh_private_key,
    load_ssh_public_key,
)

from aurora_cli.allowed_signers import key_lines
from aurora_cli.output import UsageProblem
from aurora_core.errors import AuroraError
from aurora_core.files import read_bytes
from aurora_core.report.signed_run import Signer, Verifier

# A file of trusted keys may hold some hundred lines.
_KEY_BYTES = 1 << 16
_OTHERS = stat.S_IRWXG | stat.S_IRWXO
# The field of edwards25519, and y of its eight points of small order: whatever x, and also where y
# is written unreduced. Chalkias, Garillot, Nikolaenko: Taming the many EdDSAs (SSR 2020), table 1.
_P = 2**255 - 19
_Y8 = 0x05FC536D880238B13933C6D305ACDFD5F098EFF289F4C345B027B2C28F95E826
_SMALL_ORDER_Y = frozenset((0, 1, _P - 1, _Y8, _P - _Y8))
_OPENSSH = b'-----BEGIN OPENSSH PRIVATE KEY-----'


def fingerprint(key: Ed25519PublicKey) -> str:
    """Return the name of a key as `ssh-keygen -l` shows it."""
    blob = base64.b64decode(key.public_bytes(Encoding.OpenSSH, PublicFormat.OpenSSH).split()[1])
    return 'SHA256:' + base64.b64encode(hashlib.sha256(blob).digest()).decode().rstrip('=')


def make_key(path: Path) -> None:
    """Make a key that only its user may read, and `<path>.pub` beside it.

    Raises:
        UsageProblem: One of the files exists, or cannot be written.
    """
    key = Ed25519PrivateKey.generate()
    private = key.private_bytes(Encoding.PEM, PrivateFormat.OpenSSH, NoEncryption())
    public = key.public_key().public_bytes(Encoding.OpenSSH, PublicFormat.OpenSSH) + b'\n'
    for name, data, mode in ((path, private, 0o600), (_public(path), public, 0o644)):
        try:
            with os.fdopen(os.open(name, os.O_WRONLY | os.O_CREAT | os.O_EXCL, mode), 'wb') as out:
                out.write(data)
        except OSError as err:
            raise UsageProblem(f'{name} cannot be made: {err.strerror or err}') from err


def load_signer(path: Path) -> tuple[Signer, str]:
    """Return what signs with a private key, and the fingerprint of the key.

    Raises:
        UsageProblem: There is no such file, others may read it, or it holds no such key.
    """
    data = _read(path)
    if path.stat().st_mode & _OTHERS:
        raise UsageProblem(f'{path} can be read by others: chmod 600 {path}')
    key = _private(path, data)
    return key.sign, fingerprint(key.public_key())


def load_trusted(path: Path) -> Verifier:
    """Return what checks signatures by the public keys of a file.

    Args:
        path: A PEM public key, or lines as in `<key>.pub` and `allowed_signers` of OpenSSH.

    Raises:
        UsageProblem: There is no such file, it holds something else, too, or no key that may
            vouch for a run now.
    """
    keys = _publics(path, _read(path))

    def verifier(message: bytes, signature: bytes) -> str | None:
        for key in keys:
            try:
                key.verify(signature, message)
            except InvalidSignature:
                continue
            return fingerprint(key)
        return None

    return verifier


def _read(path: Path) -> bytes:
    try:
        return read_bytes(path, _KEY_BYTES)
    except AuroraError as err:
        raise UsageProblem(err.message) from err
    except OSError as err:
        raise UsageProblem(f'{path} cannot be read: {err.strerror or err}') from err


def _private(path: Path, data: bytes) -> Ed25519PrivateKey:
    load = load_ssh_private_key if data.lstrip().startswith(_OPENSSH) else load_pem_private_key
    try:
        try:
            key = load(data, None)
        except TypeError:  # it wants a passphrase
            if not sys.stdin.isatty():
                raise UsageProblem(
                    f'{path} needs a passphrase, and there is no terminal'
                ) from None
            key = load(data, getpass.getpass(f'passphrase of {path}: ').encode())
    except (ValueError, UnsupportedAlgorithm) as err:
        raise UsageProblem(f'{path} holds no private key that can be read: {err}') from err
    if not isinstance(key, Ed25519PrivateKey):
        raise UsageProblem(f'{path} is no Ed25519 key: ssh-keygen -t ed25519 makes one')
    return key


def _publics(path: Path, data: bytes) -> list[Ed25519PublicKey]:
    if b'PRIVATE KEY' in data:
        raise UsageProblem(f'{path} is a private key: name the public one, {_public(path)}')
    try:
        if data.lstrip().startswith(b'-----BEGIN'):
            return [_trustworthy(load_pem_public_key(data))]
        lines = list(key_lines(data.decode(), datetime.now().astimezone()))
        keys = [
            _trustworthy(load_ssh_public_key(line.key.encode()), f'line {line.number} holds ')
            for line in lines
            if line.unfit is None
        ]
    except (ValueError, UnsupportedAlgorithm) as err:
        raise UsageProblem(f'{path} is no file of Ed25519 public keys: {err}') from err
    if not keys:
        why = '; '.join(f'line {line.number} {line.unfit}' for line in lines)
        raise UsageProblem(f'{path} holds no key that vouches for a run: {why or "it is empty"}')
    return keys


def _trustworthy(key: PublicKeyTypes | SSHPublicKeyTypes, where: str = '') -> Ed25519PublicKey:
    """Return a key that only its owner signs with.

    Raises:
        ValueError: It is of another kind, or a point of small order.
    """
    if not isinstance(key, Ed25519PublicKey):
        raise ValueError(f'{where}a key that is no Ed25519 key')
    # The top bit is the sign of x; y need not be reduced (RFC 8032, 5.1.2).
    y = int.from_bytes(key.public_bytes_raw(), 'little') & ((1 << 255) - 1)
    if y % _P in _SMALL_ORDER_Y:
        raise ValueError(f'{where}a point of small order, under which anybody can sign')
    return key


def _public(path: Path) -> Path:
    return path.with_name(f'{path.name}.pub')

# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora sign` and `aurora verify --trusted`: who rewrites a whole run in agreement is found."""

from __future__ import annotations

import base64
import hashlib
import io
import json
import os
import shutil
import subprocess
from collections.abc import Callable
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path
from types import SimpleNamespace

import pytest
from cryptography.hazmat.primitives.asymmetric.ec import SECP256R1, generate_private_key
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
from cryptography.hazmat.primitives.serialization import (
    BestAvailableEncryption,
    Encoding,
    NoEncryption,
    PrivateFormat,
    PublicFormat,
)
from run_folders import judged_once

import aurora
from aurora_cli import answers
from aurora_cli.main import run_command_line
from aurora_core.errors import AuroraError
from aurora_core.report.run_folder import RunFolder

Call = Callable[..., SimpleNamespace]


@pytest.fixture(scope='module')
def keys(tmp_path_factory: pytest.TempPathFactory) -> SimpleNamespace:
    """The user's key, and one of somebody else."""
    from aurora_cli.signing import make_key

    folder = tmp_path_factory.mktemp('keys')
    make_key(folder / 'mine')
    make_key(folder / 'other')
    return SimpleNamespace(
        folder=folder,
        mine=str(folder / 'mine'),
        trusted=str(folder / 'mine.pub'),
        other=str(folder / 'other'),
    )


@pytest.fixture
def signed(run: Path, keys: SimpleNamespace, call: Call) -> Path:
    assert call('sign', run.name, '--key', keys.mine).code == 0
    return run


def test_a_signed_run_is_verified_and_its_first_line_says_by_whom(
    signed: Path, keys: SimpleNamespace, call: Call
) -> None:
    answer = call('verify', str(signed), '--trusted', keys.trusted)
    assert answer.code == 0, answer.out
    files = [p for p in signed.rglob('*') if p.is_file()]
    first = answer.out.splitlines()[0]
    assert first.startswith('VERIFIED'), first
    assert 'Signed by SHA256:' in first
    assert f'{len(files) - 2} files as signed' in first
    document = json.loads(call('verify', str(signed), '--trusted', keys.trusted, '--json').out)
    assert document['signature']['key'] in first
    assert document['signature']['doubts'] == []


def test_without_trusted_keys_a_signature_changes_nothing(
    signed: Path, finished: SimpleNamespace, call: Call
) -> None:
    with_signature = json.loads(call('verify', str(signed), '--json').out)
    without = json.loads(call('verify', str(finished.folder), '--json').out)
    assert {**with_signature, 'bag': ''} == {**without, 'bag': ''}
    assert without['signature'] is None


def test_who_rewrites_the_whole_run_in_agreement_is_found(
    signed: Path,
    keys: SimpleNamespace,
    shell: SimpleNamespace,
    call: Call,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The forged run is a real one under the same id: nothing in its folder disagrees."""
    signatures = {p.name: p.read_bytes() for p in signed.glob('signed.*')}
    run_id, root = signed.name, signed.parent
    shutil.rmtree(signed)
    fresh = answers.new_folder

    def same_id(where: Path) -> tuple[RunFolder, dict[str, object]]:
        return RunFolder(where, run_id), fresh(where)[1]

    monkeypatch.setattr(answers, 'new_folder', same_id)
    with chdir(root.parent), redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
        assert run_command_line(['run', shell.prompt, '--seed', '2', '--json']) == 0
    forged = call('verify', str(signed))
    assert (forged.code, forged.out.split()[0]) == (0, 'VERIFIED')

    found = call('verify', str(signed), '--trusted', keys.trusted)
    assert found.code == 4
    assert 'Nothing is claimed: it is not signed: signed.json is missing' in found.out

    for name, data in signatures.items():
        (signed / name).write_bytes(data)
    found = call('verify', str(signed), '--trusted', keys.trusted)
    assert found.code == 4
    first = found.out.splitlines()[0]
    assert first.startswith('INCONCLUSIVE')
    assert 'changed since it was signed: agsg.0.json, bag.0/' in first

    assert call('sign', str(signed), '--key', keys.other).code == 0
    found = call('verify', str(signed), '--trusted', keys.trusted)
    assert found.code == 4
    assert 'no trusted key signed its signed.json' in found.out


def test_every_file_of_a_run_is_under_the_signature(
    signed: Path, keys: SimpleNamespace, call: Call
) -> None:
    """One more byte at the end of any file, or any file gone, and nothing is claimed."""
    files = sorted(p for p in signed.rglob('*') if p.is_file())
    kept = {path: path.read_bytes() for path in files}
    told = []
    for path, data in kept.items():
        for forged in (data + b' ', None):
            if forged is None:
                path.unlink()
            else:
                path.write_bytes(forged)
            with judged_once():  # what the bytes of the bag give does not depend on a signature
                code = call('verify', str(signed), '--trusted', keys.trusted).code
            told.append((path.name, forged is None, code))
            path.write_bytes(data)
    # Blanks after the signature are no part of it.
    assert [item for item in told if item[2] != 4] == [('signed.sig', False, 0)]
    assert call('verify', str(signed), '--trusted', keys.trusted).code == 0


@pytest.mark.parametrize(
    ('name', 'code'),
    [
        ('verdict.1.json', 4),
        ('edits.0.json', 4),
        ('picture.png', 4),
        ('bag.0/second.mcap', 4),
        ('bag.1/bag.1_0.mcap', 4),
        ('notes.txt', 0),
        ('bag.0.csv/states.csv', 0),
    ],
)
def test_what_is_added_counts_when_it_could_be_taken_for_part_of_the_run(
    name: str, code: int, signed: Path, keys: SimpleNamespace, call: Call
) -> None:
    (signed / name).parent.mkdir(exist_ok=True)
    (signed / name).write_bytes(b'{}')
    answer = call('verify', str(signed), '--iteration', '0', '--trusted', keys.trusted, '--json')
    assert answer.code == code
    signature = json.loads(answer.out)['signature']
    if code:
        assert any(name in d['text'] and 'added' in d['text'] for d in signature['doubts'])
    else:
        assert signature['unsigned'] == [name]


def test_a_link_or_a_pipe_in_a_run_is_neither_signed_nor_believed(
    run: Path, keys: SimpleNamespace, call: Call
) -> None:
    page = run / 'report.html'
    elsewhere = run.parent / 'elsewhere.html'
    page.rename(elsewhere)
    page.symlink_to(elsewhere)
    answer = call('sign', str(run), '--key', keys.mine)
    assert (answer.code, 'is a link' in answer.err) == (4, True)
    page.unlink()
    elsewhere.rename(page)
    assert call('sign', str(run), '--key', keys.mine).code == 0
    os.mkfifo(run / 'notes')
    found = call('verify', str(run), '--trusted', keys.trusted)
    assert (found.code, 'notes is a link, a pipe or a device' in found.out) == (4, True)


def test_an_unfinished_run_is_not_signed(run: Path, keys: SimpleNamespace, call: Call) -> None:
    (run / 'report.json').unlink()
    answer = call('sign', str(run), '--key', keys.mine)
    assert answer.code == 4
    assert 'only a finished run is signed' in answer.err
    assert not (run / 'signed.json').exists()


def test_a_bag_alone_is_not_signed(
    signed: Path, here: Path, keys: SimpleNamespace, call: Call
) -> None:
    shutil.copytree(signed / 'bag.0', here / 'alone')
    answer = call('verify', str(here / 'alone'), '--trusted', keys.trusted)
    assert (answer.code, 'a bag without its run folder is not signed' in answer.out) == (4, True)


def test_a_signed_run_stays_as_it_is(
    signed: Path, here: Path, keys: SimpleNamespace, call: Call
) -> None:
    """What draws into a run folder would break its signature."""
    assert call('open', str(signed)).code == 0
    answer = call('picture', str(signed))
    assert (answer.code, '-o FILE' in answer.err) == (64, True)
    assert not (signed / 'picture.png').exists()
    assert call('verify', str(signed), '--trusted', keys.trusted).code == 0


def test_other_tools_can_check_what_was_signed(run: Path, here: Path, call: Call) -> None:
    if shutil.which('openssl') is None:
        pytest.skip('there is no openssl')

    def openssl(*arguments: str) -> None:
        subprocess.run(['openssl', *arguments], check=True, capture_output=True)

    openssl('genpkey', '-algorithm', 'ed25519', '-out', 'key.pem')
    (here / 'key.pem').chmod(0o600)
    openssl('pkey', '-in', 'key.pem', '-pubout', '-out', 'key.pub.pem')
    assert call('sign', str(run), '--key', 'key.pem').code == 0
    (here / 'sig').write_bytes(base64.b64decode((run / 'signed.sig').read_bytes()))
    document = str(run / 'signed.json')
    asked = ('-verify', '-pubin', '-inkey', 'key.pub.pem', '-rawin', '-in', document)
    openssl('pkeyutl', *asked, '-sigfile', 'sig')
    for entry in json.loads(Path(document).read_text())['files']:
        data = (run / entry['name']).read_bytes()
        assert hashlib.sha256(data).hexdigest() == entry['sha256']


def test_keys_of_other_makers_are_read_and_wrong_ones_are_named(
    run: Path, here: Path, keys: SimpleNamespace, call: Call
) -> None:
    def written(name: str, data: bytes, mode: int = 0o600) -> str:
        (here / name).write_bytes(data)
        (here / name).chmod(mode)
        return str(here / name)

    key = Ed25519PrivateKey.generate()
    pem = key.private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption())
    spki = key.public_key().public_bytes(Encoding.PEM, PublicFormat.SubjectPublicKeyInfo)
    assert call('sign', str(run), '--key', written('own.pem', pem)).code == 0
    trusted = written('own.pub.pem', spki, 0o644)
    assert call('verify', str(run), '--trusted', trusted).code == 0
    line = key.public_key().public_bytes(Encoding.OpenSSH, PublicFormat.OpenSSH)
    others = Path(keys.trusted).read_bytes()
    several = written('allowed', b'# who\n' + others + b'me@here ' + line + b' note\n', 0o644)
    assert call('verify', str(run), '--trusted', several).code == 0

    locked = key.private_bytes(
        Encoding.PEM, PrivateFormat.PKCS8, BestAvailableEncryption(b'secret')
    )
    curve = generate_private_key(SECP256R1()).private_bytes(
        Encoding.PEM, PrivateFormat.PKCS8, NoEncryption()
    )
    (run / 'inside.pem').write_bytes(pem)
    for name, said in (
        (written('open.pem', pem, 0o644), 'can be read by others'),
        (written('curve.pem', curve), 'no Ed25519 key'),
        (written('text.pem', b'hello'), 'no private key'),
        (written('locked.pem', locked), 'needs a passphrase'),
        (str(here / 'none.pem'), 'No such file'),
        ('/dev/zero', 'regular file'),
        (str(run / 'inside.pem'), 'lies in the run'),
    ):
        answer = call('sign', str(run), '--key', name)
        assert (answer.code, said in answer.err) == (64, True), (name, answer.err)
    for name, said in (
        (written('mine.copy', Path(keys.mine).read_bytes()), 'is a private key'),
        (written('empty', b''), 'holds no key'),
        (written('words', b'hello there\n'), 'no file of Ed25519 public keys'),
        (written('rsa', b'me ssh-rsa AAAAB3NzaC1yc2E=\n'), 'no file of Ed25519 public keys'),
    ):
        answer = call('verify', str(run), '--trusted', name)
        assert (answer.code, said in answer.err) == (64, True), (name, answer.err)


@pytest.mark.parametrize(
    ('beside', 'said'),
    [
        ('me@here valid-before="20200101" ', 'line 2 was valid before 20200101'),
        ('me@here valid-after="29990101Z" ', 'line 2 is valid after 29990101Z only'),
        ('me@here namespaces="git,file" ', 'line 2 is for the namespaces git,file'),
        ('me@here cert-authority ', 'line 2 has the option cert-authority'),
        ('me@here VALID-BEFORE="soon" ', 'line 2 has the time soon'),
        ('me@here valid-before="29990101",valid-before="29990101" ', 'stands there twice'),
        ('me@here zone="a b" ', 'line 2 has the option zone'),
        ('valid-before="20200101" ', 'line 2 begins with the option'),
        ('cert-authority ', 'line 2 begins with the option'),
        ('@revoked me@here ', 'line 2 has the marker @revoked'),
        ('@revoked ', 'line 2 has the marker @revoked'),
        ('me@here valid-before="20200101 ', 'line 2 holds no public key'),
    ],
)
def test_what_stands_beside_a_trusted_key_is_respected(
    beside: str, said: str, signed: Path, here: Path, keys: SimpleNamespace, call: Call
) -> None:
    (here / 'allowed').write_text(f'# who\n{beside}{Path(keys.trusted).read_text()}')
    answer = call('verify', str(signed), '--trusted', 'allowed')
    assert (answer.code, said in answer.err) == (64, True), answer.err


def test_an_expired_line_leaves_the_other_keys_trusted(
    signed: Path, here: Path, keys: SimpleNamespace, call: Call
) -> None:
    other, mine = Path(f'{keys.other}.pub').read_text(), Path(keys.trusted).read_text()
    now = 'namespaces="file,aurora",valid-after="20200101",valid-before="299901010000Z"'
    (here / 'allowed').write_text(f'me valid-before="20200101Z" {other} "me" {now} {mine}')
    assert call('verify', str(signed), '--trusted', 'allowed').code == 0
    (here / 'allowed').write_text(f'me valid-before="20200101Z" {mine} me {now} {other}')
    assert call('verify', str(signed), '--trusted', 'allowed').code == 4


def _of_order_8(p: int) -> int:
    """Return y of a point of edwards25519 whose double has y = 0: d y^4 + 2 y^2 = 1."""
    d = -121665 * pow(121666, -1, p)

    def root(square: int) -> int | None:
        found = pow(square, (p + 3) // 8, p)
        both = (found, found * pow(2, (p - 1) // 4, p) % p)
        return next((r for r in both if (r * r - square) % p == 0), None)

    half = root((1 + d) % p)
    assert half is not None
    both = [root((r - 1) * pow(d, -1, p) % p) for r in (half, -half)]
    return next(y for y in both if y is not None)


def test_a_point_under_which_anybody_signs_is_no_trusted_key(
    signed: Path, here: Path, call: Call
) -> None:
    """The neutral point with a signature of zeros would verify every folder."""
    p = 2**255 - 19
    y8 = _of_order_8(p)
    for y in (0, 1, p - 1, y8, p - y8, p, p + 1):
        for sign in (0, 1 << 255):
            point = (y | sign).to_bytes(32, 'little')
            blob = b'\0\0\0\x0bssh-ed25519\0\0\0 ' + point
            (here / 'key').write_text(f'me ssh-ed25519 {base64.b64encode(blob).decode()}\n')
            answer = call('verify', str(signed), '--trusted', 'key')
            assert (answer.code, 'line 1 holds a point of small order' in answer.err) == (64, True)


def test_a_new_key_is_for_its_user_alone_and_never_replaces_one(
    run: Path, here: Path, call: Call
) -> None:
    assert call('sign', str(run), '--key', 'fresh', '--new-key').code == 0
    assert (here / 'fresh').stat().st_mode & 0o077 == 0
    before = (here / 'fresh').read_bytes()
    assert call('verify', str(run), '--trusted', 'fresh.pub').code == 0
    assert call('sign', str(run), '--key', 'fresh', '--new-key').code == 64
    assert (here / 'fresh').read_bytes() == before
    for path in run.rglob('*'):
        assert path.is_dir() or before not in path.read_bytes()


def test_the_library_asks_for_a_signature_too(signed: Path, keys: SimpleNamespace) -> None:
    assert aurora.verify(signed, trusted=keys.trusted).outcome.value == 'verified'
    assert aurora.verify(signed, trusted=f'{keys.other}.pub').outcome.value == 'inconclusive'
    with pytest.raises(AuroraError, match='No such file'):
        aurora.verify(signed, trusted='nobody.pub')

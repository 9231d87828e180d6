# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What cannot become a map ends in words, quickly, and leaves nothing behind."""

from __future__ import annotations

import errno
import gzip
import os
import re
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

from aurora_cli.map_import import importer, netconvert, source
from aurora_cli.testing.small_maps import small_city, xodr
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.map_model import load_map

Call = Callable[..., SimpleNamespace]
# Nothing that is refused takes as long on any machine; about 0.1 s is usual.
HANGS_S = 60.0

CITY = small_city()
ROAD = '<way id="9"><nd ref="1"/><nd ref="2"/><tag k="highway" v="{}"/></way>'
BOMB = (
    '<?xml version="1.0"?><!DOCTYPE osm [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;">'
    '<!ENTITY c "&b;&b;&b;&b;&b;&b;">]><osm version="0.6"><node id="1" lat="1" lon="&c;"/></osm>'
)
EXTERNAL = (
    '<?xml version="1.0"?><!DOCTYPE osm [<!ENTITY x SYSTEM "file:///etc/passwd">]>'
    '<osm version="0.6"><node id="1" lat="1" lon="1"><tag k="name" v="&x;"/></node></osm>'
)


def _osm(*roads: str, second: str = 'lat="60.001" lon="24"') -> bytes:
    nodes = f'<node id="1" lat="60" lon="24"/><node id="2" {second}/>'
    return f'<osm version="0.6">{nodes}{"".join(roads)}</osm>'.encode()


def _scribble(count: int) -> bytes:
    """A city with a building whose outline crosses itself at almost every step."""
    spots = [(60.17 + 1e-5 * (k * 37 % 101), 24.94 + 1e-5 * (k * 53 % 97)) for k in range(count)]
    nodes = ''.join(
        f'<node id="{1000 + k}" lat="{lat:.6f}" lon="{lon:.6f}"/>'
        for k, (lat, lon) in enumerate(spots)
    )
    ring = ''.join(f'<nd ref="{1000 + k}"/>' for k in (*range(count), 0))
    building = f'<way id="9999">{ring}<tag k="building" v="yes"/></way>'
    return CITY.replace('</osm>', f'{nodes}{building}</osm>').encode()


def _junction(old: str, new: str) -> bytes:
    """The network of the bundled junction with something in it changed everywhere."""
    packed = config_path('maps', 'junction', 'net.xml.gz').read_bytes()
    text, changed = re.subn(old, new, gzip.decompress(packed).decode())
    assert changed
    return text.encode()


LANES = ROAD.format('primary').replace('</way>', '<tag k="lanes" v="1000000"/></way>')
ENDLESS = xodr(walkways=False).replace('<line/>', '<arc curvature="1e-9"/>')
WIDE = ''.join(
    f'<lane id="-{k}" type="driving" level="false"><width sOffset="0" a="3" b="0" c="0" d="0"/>'
    '</lane>' for k in range(2, 40)
)  # fmt: skip

REFUSED = {
    'empty.osm': (b'', 'is empty'),
    'empty.osm.gz': (gzip.compress(b''), 'neither XML nor PBF'),
    'short.osm': (CITY[: len(CITY) // 2].encode(), 'breaks off'),
    'short.osm.gz': (gzip.compress(CITY.encode())[:500], 'breaks off'),
    'bomb.osm': (BOMB.encode(), 'document type or entities'),
    'external.osm': (EXTERNAL.encode(), 'document type or entities'),
    'include.net.xml': (b'<net><include href="/etc/passwd"/></net>', 'includes other files'),
    'page.osm': (b'<html><body>no map</body></html>', 'begins with <html>'),
    'text.xodr': (b'not a map at all', 'neither XML nor PBF'),
    'packed.osm': (b'PK\x03\x04' + bytes(50), 'packed with zip'),
    'deep.osm': (b'<osm>' + b'<a>' * 1000, 'deep'),
    'points.osm': (_osm(), 'no road'),
    'paths.osm': (_osm(ROAD.format('footway')), 'gives no road network'),
    'nowhere.osm': (_osm(second='lat="nan" lon="24"'), "coordinate: 'nan'"),
    'world.osm': (_osm(ROAD.format('primary'), second='lat="1" lon="2"'), 'more than the 60 km'),
    'empty.net.xml': (b'<net version="1.20"></net>', 'gives no road network'),
    'empty.xodr': (b'<OpenDRIVE></OpenDRIVE>', 'gives no road network'),
    'left.net.xml': (b'<net version="1.20" lefthand="true"></net>', 'driving on the left'),
    'encoding.osm': (b'<?xml version="1.0" encoding="x-none"?><osm/>', 'unknown encoding'),
    'lanes.osm': (_osm(LANES), 'has 1000000 lanes'),
    'long.osm': (_osm().replace(b'id="1"', b'id="' + b'x' * 5000 + b'"'), 'illegal id'),
    'scribble.osm': (_scribble(2000), 'cross themselves more than'),
    'endless.xodr': (ENDLESS.replace('"300"', '"1e12"').encode(), 'no end of it'),
    'wide.xodr': (
        xodr(walkways=False).replace('</right>', f'{WIDE}</right>').encode(),
        'lanes in one direction',
    ),
    'frozen.net.xml': (_junction('duration="[0-9]+"', 'duration="0"'), 'SUMO does not start'),
    'cut.osm.pbf': (b'\0\0\0\x0d\x0a\x09OSMHeader\x18\x7f' + b'x' * 20, 'unexpected EOF'),
}


@pytest.mark.parametrize('name', REFUSED)
def test_a_file_that_is_no_map_is_refused_in_words(
    name: str, own: Path, tmp_path: Path, call: Call
) -> None:
    data, words = REFUSED[name]
    file = tmp_path / name
    file.write_bytes(data)
    begin_s = time.monotonic()
    done = call('map', 'import', str(file), '--name', 'x')
    assert time.monotonic() - begin_s < HANGS_S
    assert done.code == 4
    assert words in done.err
    assert done.out == ''
    assert 'Traceback' not in done.err
    assert 'defect' not in done.err
    assert list(own.iterdir()) == []


def test_what_unpacks_without_end_is_stopped(
    own: Path, tmp_path: Path, call: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(source, 'XML_BYTES', 1 << 20)
    file = tmp_path / 'bomb.osm.gz'
    file.write_bytes(gzip.compress(b'<osm>' + bytes(50 << 20)))
    done = call('map', 'import', str(file), '--name', 'x')
    assert done.code == 4
    assert 'unpacks to more than 1 MiB' in done.err
    assert list(own.iterdir()) == []


def test_a_region_is_too_large(own: Path, tmp_path: Path, call: Call) -> None:
    file = tmp_path / 'region.osm'
    node = '<node id="{0}" lat="60" lon="24"/>'
    body = ''.join(node.format(i) for i in range(1, source.MOST_NODES + 2))
    file.write_text(f'<osm version="0.6">{body}</osm>')
    begin_s = time.monotonic()
    done = call('map', 'import', str(file), '--name', 'x')
    assert time.monotonic() - begin_s < HANGS_S
    assert done.code == 4
    assert f'more than {source.MOST_NODES} nodes' in done.err
    assert 'cut out a smaller part' in done.err


def test_no_file_a_folder_and_a_pipe(own: Path, tmp_path: Path, call: Call) -> None:
    assert call('map', 'import', str(tmp_path / 'none.osm')).code == 64
    pipe = tmp_path / 'pipe.osm'
    os.mkfifo(pipe)
    done = call('map', 'import', str(pipe))
    assert done.code == 4
    assert 'expected a regular file' in done.err
    (tmp_path / 'folder.osm').mkdir()
    done = call('map', 'import', str(tmp_path / 'folder.osm'))
    assert done.code == 4
    assert 'cannot be read: Is a directory' in done.err


@pytest.mark.parametrize('name', ['../x', 'a/b', '.x', 'Grand', '', 'x' * 65, 'a\nb', '-x'])
def test_names_that_no_map_can_have(
    own: Path, files: SimpleNamespace, call: Call, name: str
) -> None:
    done = call('map', 'import', str(files.xodr), f'--name={name}')
    assert done.code == 64
    assert 'cannot be named' in done.err
    assert not own.exists()


@pytest.mark.parametrize('name', ['downtown', 'road'])
def test_a_map_is_never_replaced(own: Path, files: SimpleNamespace, call: Call, name: str) -> None:
    assert call('map', 'import', str(files.xodr), '--name', 'road').code == 0
    before = (own / 'road' / 'map.json').read_bytes()
    done = call('map', 'import', str(files.net), '--name', name)
    assert done.code == 4
    assert f'there is a map {name} already' in done.err
    assert (own / 'road' / 'map.json').read_bytes() == before
    assert [path.name for path in own.iterdir()] == ['road']


def test_a_full_disk_leaves_nothing(
    own: Path, files: SimpleNamespace, call: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(importer, 'write_features', full)
    done = call('map', 'import', str(files.xodr))
    assert done.code == 4
    assert 'No space left on device' in done.err
    assert 'AURORA_MAPS' in done.err
    assert list(own.iterdir()) == []


def test_a_network_that_netconvert_breaks_off_is_not_taken(
    own: Path, files: SimpleNamespace, call: Call, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """On a full disk it writes as far as it gets and says that all went well."""
    program = tmp_path / 'netconvert'
    program.write_text(
        '#!/bin/sh\nwhile [ "$1" != --output-file ]; do shift; done\nprintf "<net><ed" > "$2"\n'
    )
    program.chmod(0o755)
    monkeypatch.setattr('sysconfig.get_path', lambda _name: str(tmp_path))
    for file in (files.xodr, files.osm):
        done = call('map', 'import', str(file))
        assert done.code == 4
        assert 'could not write all of its network' in done.err
        assert 'make room' in done.err
    assert list(own.iterdir()) == []


def test_netconvert_and_what_it_started_are_stopped(
    own: Path, files: SimpleNamespace, call: Call, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """In its wheel it is a script that starts the program: the script alone is not enough."""
    pid_file = tmp_path / 'pid'
    program = tmp_path / 'netconvert'
    program.write_text(f'#!/bin/sh\nsleep 300 &\necho $! > {pid_file}\nwait\n')
    program.chmod(0o755)
    monkeypatch.setattr('sysconfig.get_path', lambda _name: str(tmp_path))
    monkeypatch.setattr(netconvert, '_LIMIT_S', 2.0)
    done = call('map', 'import', str(files.xodr))
    assert done.code == 4
    assert 'netconvert was not done' in done.err
    started = int(pid_file.read_text())
    until_s = time.monotonic() + HANGS_S
    while _runs(started) and time.monotonic() < until_s:
        time.sleep(0.05)
    assert not _runs(started)


def _runs(pid: int) -> bool:
    """Whether a process is there and no zombie."""
    try:
        return Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()[0] != 'Z'
    except OSError:
        return False


def test_streets_on_which_nobody_may_move_are_opened(
    own: Path, tmp_path: Path, call: Call
) -> None:
    file = tmp_path / 'slow.net.xml'
    file.write_bytes(_junction(' speed="[^"]*"', ' speed="0.00001"'))
    assert call('map', 'import', str(file)).code == 0
    assert min(lane.speed_limit_mps for lane in load_map('slow').network.lanes.values()) >= 0.5
    checked = call('check', '--map', 'slow', 'A drone tracks a car.')
    assert 'defect' not in checked.err
    assert checked.code in (0, 6)


def test_ctrl_c_leaves_nothing(
    own: Path, files: SimpleNamespace, call: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(importer, 'write_manifest', interrupted)
    assert call('map', 'import', str(files.xodr)).code == 130
    assert list(own.iterdir()) == []


def test_what_a_killed_import_left_is_removed_later(
    own: Path, files: SimpleNamespace, call: Call
) -> None:
    left, running = own / '.importing-old', own / '.importing-new'
    left.mkdir(parents=True)
    running.mkdir()
    os.utime(left, (time.time() - 7200.0,) * 2)
    assert call('map', 'import', str(files.xodr)).code == 0
    assert not left.exists()
    assert running.exists()


def test_without_netconvert_it_says_what_to_install(
    own: Path, files: SimpleNamespace, call: Call, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr('sysconfig.get_path', lambda _name: str(tmp_path))
    monkeypatch.setenv('PATH', str(tmp_path))
    done = call('map', 'import', str(files.xodr))
    assert done.code == 4
    assert 'netconvert is not installed' in done.err
    assert 'eclipse-sumo' in done.err

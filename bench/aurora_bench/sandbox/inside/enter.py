# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Leave everything behind by namespaces of one's own, then run a command.

`python enter.py JSON` with `root` (an empty folder), `binds` (paths that stay, read-only),
`links` (symbolic links at the top, name to target), `scene` (folder that becomes `/scene`) and
`argv`. No right is needed but that to make user namespaces. The command is process 1 of its own
world: no network, no process but itself, no file but the named ones, none of them writable.
"""

from __future__ import annotations

import ctypes
import json
import os
import signal
import sys
from typing import Any

_NEW = 0x00020000 | 0x02000000 | 0x04000000 | 0x08000000 | 0x10000000 | 0x20000000 | 0x40000000
_NOBODY = 65534
_MS_NOSUID, _MS_NODEV, _MS_BIND, _MS_REC, _MS_PRIVATE = 2, 4, 4096, 16384, 1 << 18
_MNT_DETACH = 2
_PDEATHSIG = 1
# x86_64 alone, like the filter of system calls.
_PIVOT_ROOT, _MOUNT_SETATTR = 155, 442
_AT_FDCWD, _AT_RECURSIVE = -100, 0x8000
_READ_ONLY_NOSUID_NODEV = 1 | 2 | 4

_libc = ctypes.CDLL(None, use_errno=True)


class _MountAttr(ctypes.Structure):
    _fields_ = (
        ('attr_set', ctypes.c_uint64),
        ('attr_clr', ctypes.c_uint64),
        ('propagation', ctypes.c_uint64),
        ('userns_fd', ctypes.c_uint64),
    )


def _check(result: int, what: str) -> None:
    if result != 0:
        number = ctypes.get_errno()
        raise OSError(number, f'{what}: {os.strerror(number)}')


def _mount(source: str, target: str, kind: str, flags: int, data: str = '') -> None:
    given = (source.encode(), target.encode(), kind.encode(), ctypes.c_ulong(flags), data.encode())
    _check(_libc.mount(*given), f'mount {target}')


def _write(path: str, text: str) -> None:
    with open(path, 'w', encoding='ascii') as stream:
        stream.write(text)


def _isolate() -> None:
    user, group = os.geteuid(), os.getegid()
    _check(_libc.unshare(_NEW), 'unshare')
    _write('/proc/self/setgroups', 'deny')
    _write('/proc/self/uid_map', f'{_NOBODY} {user} 1')
    _write('/proc/self/gid_map', f'{_NOBODY} {group} 1')


def _keep(source: str, target: str) -> None:
    if os.path.isdir(source):
        os.makedirs(target, exist_ok=True)
    else:
        os.makedirs(os.path.dirname(target), exist_ok=True)
        if not os.path.exists(target):
            _write(target, '')
    _mount(source, target, '', _MS_BIND | _MS_REC)


def _new_root(config: dict[str, Any]) -> None:
    root = config['root']
    _mount('none', '/', '', _MS_REC | _MS_PRIVATE)
    _mount('none', root, 'tmpfs', _MS_NOSUID | _MS_NODEV, 'size=1m,mode=755')
    for source in config['binds']:
        _keep(source, root + source)
    _keep(config['scene'], f'{root}/scene')
    for name, target in config['links'].items():
        os.symlink(target, root + name)
    old = f'{root}/old'
    os.mkdir(old)
    _check(_libc.syscall(_PIVOT_ROOT, root.encode(), old.encode()), 'pivot_root')
    os.chdir('/')
    _check(_libc.umount2(b'/old', _MNT_DETACH), 'umount')
    os.rmdir('/old')
    attributes = _MountAttr(attr_set=_READ_ONLY_NOSUID_NODEV)
    size = ctypes.sizeof(attributes)
    given = (_AT_FDCWD, b'/', _AT_RECURSIVE, ctypes.byref(attributes), size)
    _check(_libc.syscall(_MOUNT_SETATTR, *given), 'mount_setattr')


def main() -> None:
    config = json.loads(sys.argv[1])
    _isolate()
    _check(_libc.prctl(_PDEATHSIG, signal.SIGKILL, 0, 0, 0), 'prctl')
    child = os.fork()
    if child == 0:
        _check(_libc.prctl(_PDEATHSIG, signal.SIGKILL, 0, 0, 0), 'prctl')
        _new_root(config)
        os.execve(config['argv'][0], config['argv'], {'LANG': 'C.UTF-8'})
    _, status = os.waitpid(child, 0)
    if os.WIFSIGNALED(status):
        os.kill(os.getpid(), os.WTERMSIG(status))
    os._exit(os.waitstatus_to_exitcode(status) if os.WIFEXITED(status) else 1)


if __name__ == '__main__':
    main()

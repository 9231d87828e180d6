# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""First thing inside the sandbox: give up what is left of one's rights, then run the program.

`python guard.py CPU_S MEMORY_BYTES OUTPUT_BYTES`; the first line on standard input is the program
as JSON. The limits are the kernel's: nothing that the program does takes them back.
"""

from __future__ import annotations

import ctypes
import importlib
import json
import os
import platform
import resource
import sys
import traceback

RAISED, NO_MEMORY, UNSAFE = 70, 71, 72
_NO_NEW_PRIVS, _SET_SECCOMP, _FILTER = 38, 22, 2
_X86_64 = 0xC000003E
_ALLOW, _REFUSE, _KILL = 0x7FFF0000, 0x00050000 | 1, 0x80000000
_LOAD, _EQUAL, _RETURN = 0x20, 0x15, 0x06
# System calls of an interpreter that computes, reads its own modules and speaks over the pipes it
# has. Not among them: new processes and threads, other programs, sockets, signals to others,
# changes of files, of names, of rights, of limits upwards, devices.
_CALLS = {
    'read': 0, 'write': 1, 'open': 2, 'close': 3, 'stat': 4, 'fstat': 5, 'lstat': 6, 'poll': 7,
    'lseek': 8, 'mmap': 9, 'mprotect': 10, 'munmap': 11, 'brk': 12, 'rt_sigaction': 13,
    'rt_sigprocmask': 14, 'rt_sigreturn': 15, 'pread64': 17, 'readv': 19, 'writev': 20,
    'access': 21, 'select': 23, 'sched_yield': 24, 'mremap': 25, 'madvise': 28, 'dup': 32,
    'dup2': 33, 'nanosleep': 35, 'getpid': 39, 'exit': 60, 'uname': 63, 'fcntl': 72,
    'getcwd': 79, 'readlink': 89, 'gettimeofday': 96, 'getrlimit': 97, 'getrusage': 98,
    'sysinfo': 99, 'times': 100, 'getuid': 102, 'getgid': 104, 'geteuid': 107, 'getegid': 108,
    'getppid': 110, 'sigaltstack': 131, 'gettid': 186, 'time': 201, 'futex': 202,
    'sched_getaffinity': 204, 'getdents64': 217, 'restart_syscall': 219, 'clock_gettime': 228,
    'clock_getres': 229, 'clock_nanosleep': 230, 'exit_group': 231, 'tgkill': 234, 'openat': 257,
    'newfstatat': 262, 'readlinkat': 267, 'faccessat': 269, 'pselect6': 270, 'ppoll': 271,
    'set_robust_list': 273, 'dup3': 292, 'getrandom': 318, 'statx': 332, 'rseq': 334,
    'faccessat2': 439,
}  # fmt: skip


class _Instruction(ctypes.Structure):
    _fields_ = (
        ('code', ctypes.c_uint16),
        ('jump_true', ctypes.c_uint8),
        ('jump_false', ctypes.c_uint8),
        ('value', ctypes.c_uint32),
    )


class _Filter(ctypes.Structure):
    _fields_ = (('length', ctypes.c_uint16), ('instructions', ctypes.POINTER(_Instruction)))


def _limit(cpu_s: int, memory_bytes: int, output_bytes: int) -> None:
    for what, most in (
        (resource.RLIMIT_AS, memory_bytes),
        (resource.RLIMIT_CORE, 0),
        (resource.RLIMIT_CPU, cpu_s),
        (resource.RLIMIT_FSIZE, output_bytes),
        (resource.RLIMIT_NOFILE, 32),
    ):
        resource.setrlimit(what, (most, most))


def _forbid() -> None:
    if platform.machine() != 'x86_64':
        raise OSError(f'the filter of system calls is for x86_64, not for {platform.machine()}')
    code = [(_LOAD, 0, 0, 4), (_EQUAL, 1, 0, _X86_64), (_RETURN, 0, 0, _KILL), (_LOAD, 0, 0, 0)]
    for number in _CALLS.values():
        code += [(_EQUAL, 0, 1, number), (_RETURN, 0, 0, _ALLOW)]
    code.append((_RETURN, 0, 0, _REFUSE))
    array = (_Instruction * len(code))(*(_Instruction(*line) for line in code))
    libc = ctypes.CDLL(None, use_errno=True)
    given = _Filter(len(code), array)
    if libc.prctl(_NO_NEW_PRIVS, 1, 0, 0, 0) or libc.prctl(
        _SET_SECCOMP, _FILTER, ctypes.byref(given), 0, 0
    ):
        raise OSError(ctypes.get_errno(), 'no filter of system calls')


def main() -> None:
    cpu_s, memory_bytes, output_bytes = (int(a) for a in sys.argv[1:4])
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    # It takes the pipes before the program can write to them; by name, it is no package here.
    aurora_scene = importlib.import_module('aurora_scene')

    text = json.loads(aurora_scene.first_line())['program']
    try:
        _limit(cpu_s, memory_bytes, output_bytes)
        _forbid()
    except Exception:  # noqa: BLE001
        traceback.print_exc()
        os._exit(UNSAFE)
    code = 0
    try:
        exec(compile(text, 'program.py', 'exec'), {'__name__': '__main__'})  # noqa: S102
    except SystemExit as end:
        code = RAISED if end.code not in (None, 0) else 0
    except MemoryError:
        code = NO_MEMORY
    except BaseException:  # noqa: BLE001
        code = RAISED
        traceback.print_exc()
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except Exception:  # noqa: BLE001  (closed, replaced, or more than it may print)
            continue
    os._exit(code)


if __name__ == '__main__':
    main()

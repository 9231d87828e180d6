# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a model server may do to us: answer where it was asked, with no more than an answer has.

Every client of litellm speaks HTTP through httpx's transport, each with a session of its own and
most with redirects switched on. The transport is the one place that all of them share: while a
thread is guarded, a redirect (which would take the prompt elsewhere), a compressed body and a body
beyond the limit end the call there, before they are followed, unpacked or kept.
"""

from __future__ import annotations

import functools
import threading
from collections.abc import Iterator
from contextlib import contextmanager

import httpx

_local = threading.local()


class Guard:
    """What is allowed in one call.

    Args:
        most_bytes: Of the bodies of all responses together.

    Attributes:
        problem: Why the call was ended, '' when it was not.
        is_final: Asking again would end the same way.
    """

    def __init__(self, most_bytes: int) -> None:
        self.problem = ''
        self.is_final = False
        self._most_bytes = most_bytes
        self._left = most_bytes

    def check(self, response: httpx.Response) -> None:
        """Refuse a response by its head.

        Raises:
            httpx.RemoteProtocolError: It sends us elsewhere, or is compressed.
        """
        if 300 <= response.status_code < 400:
            self._refuse('the server sends the request elsewhere; name the right address', True)
        if response.headers.get('content-encoding', 'identity').lower() != 'identity':
            self._refuse('the server compresses its answer, and was asked not to', True)

    def take(self, count: int) -> None:
        """Count the bytes of a body.

        Raises:
            httpx.RemoteProtocolError: They are too many.
        """
        self._left -= count
        if self._left < 0:
            self._refuse(f'the answer has more than {self._most_bytes} bytes', False)

    def _refuse(self, problem: str, is_final: bool) -> None:
        self.problem, self.is_final = problem, is_final
        raise httpx.RemoteProtocolError(problem)


class _Counted(httpx.SyncByteStream):
    def __init__(self, stream: httpx.SyncByteStream, guard: Guard) -> None:
        self._stream = stream
        self._guard = guard

    def __iter__(self) -> Iterator[bytes]:
        for piece in self._stream:
            self._guard.take(len(piece))
            yield piece

    def close(self) -> None:
        self._stream.close()


@contextmanager
def guarded(most_bytes: int) -> Iterator[Guard]:
    """Guard what this thread sends and receives over httpx."""
    _install()
    guard = Guard(most_bytes)
    _local.guard = guard
    try:
        yield guard
    finally:
        _local.guard = None


@functools.cache
def _install() -> None:
    plain = httpx.HTTPTransport.handle_request

    @functools.wraps(plain)
    def handle_request(self: httpx.HTTPTransport, request: httpx.Request) -> httpx.Response:
        guard: Guard | None = getattr(_local, 'guard', None)
        if guard is None:
            return plain(self, request)
        request.headers['accept-encoding'] = 'identity'
        response = plain(self, request)
        assert isinstance(response.stream, httpx.SyncByteStream)
        try:
            guard.check(response)
        except httpx.RemoteProtocolError:
            response.close()
            raise
        response.stream = _Counted(response.stream, guard)
        return response

    httpx.HTTPTransport.handle_request = handle_request  # type: ignore[method-assign]

# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Undo a name clash: the folder at the top of the checkout is called like the package inside it.

pytest (import mode importlib) names these tests `aurora_nodes.test.…` after their place and puts
an empty namespace package of that name where the real one belongs.
"""

from __future__ import annotations

import sys

if getattr(sys.modules.get('aurora_nodes'), '__file__', None) is None:
    sys.modules.pop('aurora_nodes', None)
import aurora_nodes  # noqa: F401

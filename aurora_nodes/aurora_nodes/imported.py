# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Imported once by a process that nodes are forked off: what they import, and no more."""

from __future__ import annotations

import gc
from contextlib import suppress
from importlib import import_module

from aurora_nodes.modules import MODULES

# Names and no imports: nodes are not below each other. What is missing fails in its own node.
for _module in MODULES.values():
    with suppress(ImportError):
        import_module(_module)
# The collector of a forked node need not look at it, and so not copy it.
gc.collect()
gc.freeze()

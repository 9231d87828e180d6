# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Wordings put into plain order before clauses are cut: a module for each kind of wording.

Each gives back atoms in which a clause is told as `who does what, where, how`; `rewrite` calls
them one after the other.
"""

# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora doctor`: what is wrong with this machine and this environment, each with its fix.

One checker per file: a function that takes a `Machine` (every place that is looked at) and returns
findings. Nothing here needs more than the standard library to be imported, so that it runs where
the environment is broken; what else a check needs it imports itself.
"""

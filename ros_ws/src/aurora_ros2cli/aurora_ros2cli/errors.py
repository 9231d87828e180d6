# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The one kind of failure that a verb reports to the user."""


class CliError(Exception):
    """The command cannot be done; the message goes to standard error, the exit code is 1."""

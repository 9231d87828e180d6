# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Campaign: inputs that are changed towards code that none has reached yet (atheris)."""

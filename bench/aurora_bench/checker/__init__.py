# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""An independent checker: what a recording says of an annotation, requirement by requirement.

Written from the contract alone (what words and numbers mean, the prompt format, the limits) and
from the message definitions. It shares nothing with what it checks: no condition, event, sight or
distance of the recording is believed, and nothing of the product is imported.
"""

from aurora_bench.checker.answers import Answer, Checked, CheckerError, Outcome
from aurora_bench.checker.check import check_bag, check_recording

__all__ = ['Answer', 'Checked', 'CheckerError', 'Outcome', 'check_bag', 'check_recording']

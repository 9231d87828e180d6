# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A stand-in for the ros2 command line, with the words and the output of the real one."""

# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Several graphs at once in neighbouring ROS domains: nothing may cross, nothing may leak out."""

# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What long measurements over prompt files share: workers, a journal, files and their lines."""

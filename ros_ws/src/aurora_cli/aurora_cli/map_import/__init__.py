# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora map import`: OSM extracts, SUMO networks and OpenDRIVE files to map folders."""

# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Received power over distance: urban line of sight and blockage of 3GPP TR 37.885.

With line of sight, Table 6.2.1-1 (urban; d the 3-D distance in m, f the carrier in GHz):

    PL(d) = 38.77 + 16.7 log10(d) + 18.2 log10(f)   [dB]

What stands in between adds a blockage loss that does not depend on d below 540 m, as NLOSv there
(5 or 9 dB on average, by the heights of antennas and blocker). Buildings and vehicles add the same
here, and the amount is calibrated: the receiver hears down to what is received at the greatest
range with sight, and what is blocked falls below that at the greatest range without. 500 and 200 m
give a blockage loss of 6.6 dB, between the two of the report.

Source: 3GPP TR 37.885 (Release 15), "Study on evaluation methodology of new Vehicle-to-Everything
(V2X) use cases for LTE and NR", section 6.2.1. Left out are its shadow fading and its NLOS formula
for streets round the corner, by which nothing is heard at 200 m that is just heard at 500 m in
sight.
"""

from __future__ import annotations

from math import inf, log10

CARRIER_GHZ = 5.9
TRANSMITTED_DBM = 23.0

_AT_1_M_DB, _PER_DECADE_DB, _PER_CARRIER_DECADE_DB = 38.77, 16.7, 18.2
# Nearer the formula says nothing; the loss is that at this distance (m).
_NEAREST_M = 1.0


def path_loss_db(distance_m: float) -> float:
    """Return the path loss with line of sight in dB.

    Args:
        distance_m: 3-D distance.
    """
    far_m = max(distance_m, _NEAREST_M)
    carrier_db = _PER_CARRIER_DECADE_DB * log10(CARRIER_GHZ)
    return _AT_1_M_DB + _PER_DECADE_DB * log10(far_m) + carrier_db


def blockage_db(range_sight_m: float, range_blocked_m: float) -> float:
    """Return what buildings and vehicles in between add to the path loss in dB.

    Args:
        range_sight_m: Greatest range with line of sight.
        range_blocked_m: Greatest range without; 0: nothing passes.
    """
    if range_blocked_m <= 0.0:
        return inf
    return path_loss_db(range_sight_m) - path_loss_db(range_blocked_m)


def received_dbm(distance_m: float, blockage: float = 0.0) -> float:
    """Return the received power in dBm.

    Args:
        distance_m: 3-D distance.
        blockage: What stands in between adds to the path loss, dB.
    """
    return TRANSMITTED_DBM - path_loss_db(distance_m) - blockage

# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Loss probability over the margin of the received power: all at the range, little far inside.

The waterfall of a coded link, as a straight line in the logarithm: with every `decade_db` that
more is received than the least that is heard, ten times fewer transmissions are lost. The slope
is a setting (`link_decade_db` of the limits), not a measurement. With the path loss of
`path_loss`, distance d, range R:

    loss(d) = 10 ** (-margin(d) / decade_db) = (d / R) ** (16.7 / decade_db),   1 m <= d <= R
"""

from __future__ import annotations


def lost_share(margin_db: float, decade_db: float) -> float:
    """Return the probability that a transmission is lost, 0..1.

    Args:
        margin_db: Received power above the least that is heard.
        decade_db: Margin that makes the loss a tenth; 0: a step at the margin 0, where all passes.
    """
    if decade_db <= 0.0:
        return 0.0 if margin_db >= 0.0 else 1.0
    return 1.0 if margin_db <= 0.0 else float(10.0 ** (-margin_db / decade_db))

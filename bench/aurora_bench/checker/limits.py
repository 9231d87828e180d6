# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of the contract, written down a second time: the checker shares no configuration.

Who changes a limit for a run finds it in the recorded world; only those values that the world
carries are taken from there (`Scene.limit`), everything else stands here.
"""

from __future__ import annotations

# Limits of the world (name as in the recorded `limits_json`, unit in the name).
LIMITS: dict[str, float] = {
    'uav_endurance_s': 1500.0,
    'clearance_min_m': 3.0,
    'separation_min_m': 5.0,
    'tracking_horizontal_m': 10.0,
    'tracking_altitude_m': 5.0,
    'uav_standoff_max_m': 150.0,
    'link_range_sight_m': 500.0,
    'link_range_blocked_m': 200.0,
}
SENSING_RANGE_M = {
    'clear': 250.0,
    'cloudy': 250.0,
    'rain': 150.0,
    'snow': 120.0,
    'heavy_rain': 100.0,
    'fog': 75.0,
}
SENSING_FACTOR = {'dawn': 0.8, 'noon': 1.0, 'dusk': 0.8, 'night': 0.6}

# Tolerances of explicit numbers: (absolute, share of the value), the larger counts.
PLACEMENT_VEHICLE = (1.0, 0.02)
PLACEMENT_OTHER = (2.0, 0.05)
ALTITUDE = (2.0, 0.03)
STANDOFF = (5.0, 0.10)
SPEED = (1.0, 0.10)
WALKING = (0.2, 0.10)
DURATION = (0.5, 0.02)
WAYPOINT_M = 3.0
REALISED_SHARE = 0.01
BEARING_DEG = 15.0
CENTRED_M = 10.0
SIDE_DEG = 45.0
SIDE_SHARE = 0.80

# Shares of a phase.
ALTITUDE_SHARE = 0.95
TRACKED_SHARE = 0.80
VISIBLE_SHARE = 0.70
SPEED_SHARE = 0.80
HOVER_DRIFT_CALM_M = 2.0
HOVER_DRIFT_WIND_M = 3.0

# Who stays where it is brakes at least so much, and is so far from its set-point at most.
GENTLE_MPS2 = 1.5
FOLLOWS_M = 5.0

# Drag of the multirotor over its mass: for each m/s through the air, and for its square. A mean
# wind that a flight shows may be so far off: so much, and such a share of the gusts.
DRAG_HZ, DRAG_PER_M = 0.1, 0.008
WIND_SHOWN_MPS, WIND_SHOWN_GUSTS = 1.0, 0.6

# Actions.
# Capture follows within this after the ascent, apart from the way there (s).
CAPTURE_S = 30.0
ONSET_S = 1.0
# Who steps onto the road at some moment does so within this time of it.
STEP_S = 0.5
ACTION_DONE_S = 2.0
PHASE_SHOWS_S = 2.0
STOPPED_MPS = 0.1
STOPPED_S = 2.0
STARTED_MPS = 0.5
BRAKE_MPS2 = 4.0
DECELERATION = (0.3, 0.10)
HEADWAY = (0.3, 0.15)
VERTICAL = (0.3, 0.10)
ACCELERATE_BY_MPS = 4.0
LANE_HELD_S = 2.0
DELIVERED_S = 2.0
LATENCY_S = 0.1
RETRANSMISSIONS = 3
RETRANSMISSION_GAP_S = 0.2
LATENCY_STEPS = 2
RETURN_M = 3.0
OUTAGE_S = 0.5
RATE_SHARE = 0.10
ORBIT_DEG = 15.0

# Pairs on the road.
FOLLOW_GAP_M = (5.0, 50.0)
FOLLOW_SLOW_GAP_M = (1.0, 50.0)
FOLLOW_MOVING_MPS = 2.0
FOLLOW_SHARE = 0.8
FOLLOW_AFTER_S = 10.0
TAILGATE_GAP_S = 1.0
TAILGATE_MPS = 2.0
TAILGATE_S = 5.0
FREE_AHEAD_M = 50.0
# Nobody gives way to who passes farther away than this.
YIELDS_WITHIN_M = 60.0
VEHICLE_MPS = 50.0

# Background vehicles per kilometre of drivable street within 300 m of the anchor.
TRAFFIC_PER_KM = {'low': 3.0, 'medium': 8.0, 'high': 20.0}
TRAFFIC_RADIUS_M = 300.0
TRAFFIC_LEAST = 2
TRAFFIC_BAND = (0.70, 1.50)

# Eyes of observers: share of a vehicle's height, metres of a person; what is looked at.
DRIVER_EYE_SHARE = 0.8
PERSON_EYE_M = 1.6
VEHICLE_SIGHT_SHARE = 0.5
PERSON_SIGHT_M = 1.0
PLACE_SIGHT_M = 1.0


def tolerance(rule: tuple[float, float], value: float) -> float:
    """Return the tolerance of a number: the larger of the two parts of its rule."""
    absolute, share = rule
    return max(absolute, share * abs(value))

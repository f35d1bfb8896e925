"""The parameters of the sensors, with units: what published figures bound, and what is a judgement.

Detection of a thing of a kind at a distance d (m) in one look has the probability

    peak · peak factors / (1 + (d / (half distance · reach factor))⁴)

inside the range and the field of view, and 0 elsewhere or behind a body that occludes it. The peak factors
are those of the weather and of the time of day; the reach factor is the smaller one of the two. One look
takes one tick. By default nothing is late: 50 to 150 ms of exposure and processing are less than the tick of
0.5 s (a judgement). `Config.sensor_latency` makes it a tick.

Published figures that bound values here:

- *night, camera*: AAA, "Automatic emergency braking with pedestrian detection", 2019: no collision with a
  crossing pedestrian avoided at night; repeated in 2025: 95 % avoided by day, 60 % at night.
- *rain, camera*: AAA, "Evaluation of ADAS in simulated rain", 2021: automatic braking collided in 17 % of
  runs at 40 km/h and in 33 % at 56 km/h in moderate to heavy rain.
- *rain, radar*: Zang et al., "The impact of adverse weather conditions on autonomous vehicles", IEEE
  Vehicular Technology Magazine, 2019 (doi:10.1109/MVT.2019.2892497): up to 45 % less range in severe
  rainfall (a simulation). The
  factor 0.85 here is for ordinary rain.

Read for orientation, without a figure that is taken over:

- *devices*: Continental ARS 408-21 (long-range radar); Velodyne HDL-64E and VLP-16 (spinning lidars);
  Caesar et al., "nuScenes", CVPR 2020 (camera, lidar and radar of a test vehicle).
- *camera*: Geiger, Lenz & Urtasun, "Are we ready for autonomous driving? The KITTI vision benchmark suite",
  CVPR 2012; Fu et al., "Deep ordinal regression network for monocular depth estimation", CVPR 2018 (depth
  from one image).
- *fog*: Bijelic, Gruber & Ritter, "A benchmark for lidar sensors in fog: is detection breaking down?", IEEE
  IV 2018; Koschmieder's law (contrast falls with the meteorological visibility).
- *rain and snow*: Goodin et al., "Predicting the influence of rain on LIDAR in ADAS", Electronics 8(1),
  2019; Jokela, Kutila & Pyykönen, "Testing and validation of automotive point-cloud sensors in adverse
  weather conditions", Applied Sciences 9(11), 2019; Vargas et al., "An overview of autonomous vehicles
  sensors and their vulnerability to weather conditions", Sensors 21(16), 2021.
- *potholes*: Dhiman & Klette, "Pothole detection using computer vision and learning", IEEE Transactions on
  Intelligent Transportation Systems 21(8), 2020. A radar sees no hole in the ground.

Everything else is a judgement: ranges, fields of view and errors of measurement (the round figures of such
devices), every probability of detection near by, the shape of the fall with distance and the half
distances, the false alarms, how often a heading is read wrong, each factor of weather and light within the
bounds above, and that looks are independent of one another from tick to tick.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from sim.actions import TimeOfDay, Weather
from sim.types import Kind


@dataclass(frozen=True, slots=True)
class Effect:
    """What a condition does to a sensor, as factors of the value in clear weather by day."""

    reach: float = 1.0
    """of the half distances and the range"""
    peak: float = 1.0
    """of the probability of detection near by"""
    false_alarms: float = 1.0
    pothole: float = 1.0
    """of the probability of detection of potholes, on top of `peak`"""


@dataclass(frozen=True, slots=True)
class Target:
    """How well things of one kind are seen."""

    peak: float
    """probability of detection near by, in one look"""
    half_m: float
    """distance (m) at which half of that is left"""
    false_alarms: float
    """false alarms of this kind in one look, per 100 cells in view"""


@dataclass(frozen=True, slots=True, eq=False)
class SensorSpec:
    """One device."""

    name: str
    number: int
    """tells its random streams apart"""
    range_m: float
    view_deg: float
    """full angle of the field of view, straight ahead in its middle"""
    along: float
    """standard deviation of a measured distance, as a share of the distance"""
    across_deg: float
    """standard deviation of a measured bearing (degrees)"""
    wrong_heading: float
    """share of detected movers whose heading is read the wrong way round"""
    targets: Mapping[Kind, Target]
    weather: Mapping[Weather, Effect]
    light: Mapping[TimeOfDay, Effect]


_SAME: Final = Effect()

CAMERA: Final = SensorSpec(
    name="camera",
    number=1,
    range_m=100.0,
    view_deg=120.0,
    along=0.04,
    across_deg=0.2,
    wrong_heading=0.03,
    targets={
        Kind.VEHICLE: Target(peak=0.98, half_m=80.0, false_alarms=0.01),
        Kind.PEDESTRIAN: Target(peak=0.95, half_m=50.0, false_alarms=0.01),
        Kind.BARRIER: Target(peak=0.97, half_m=70.0, false_alarms=0.01),
        Kind.POTHOLE: Target(peak=0.92, half_m=22.0, false_alarms=0.04),
    },
    weather={
        "clear": _SAME,
        "rain": Effect(reach=0.70, peak=0.93, false_alarms=1.5, pothole=0.80),
        "fog": Effect(reach=0.33, peak=0.90, false_alarms=1.5, pothole=0.90),
        "snow": Effect(reach=0.50, peak=0.85, false_alarms=2.0, pothole=0.40),
    },
    light={
        "day": _SAME,
        "dawn": Effect(reach=0.80, peak=0.97, false_alarms=1.2),
        "dusk": Effect(reach=0.80, peak=0.97, false_alarms=1.2),
        "night": Effect(reach=0.50, peak=0.88, false_alarms=1.5, pothole=0.70),
    },
)
"""A front camera with a wide angle."""

_BY_DAY_AND_NIGHT: Final[Mapping[TimeOfDay, Effect]] = {
    "day": _SAME,
    "dawn": _SAME,
    "dusk": _SAME,
    "night": _SAME,
}
"""Sensors with a light or wave of their own."""

LIDAR: Final = SensorSpec(
    name="lidar",
    number=2,
    range_m=100.0,
    view_deg=360.0,
    along=0.0005,
    across_deg=0.1,
    wrong_heading=0.05,
    targets={
        Kind.VEHICLE: Target(peak=0.99, half_m=75.0, false_alarms=0.005),
        Kind.PEDESTRIAN: Target(peak=0.96, half_m=45.0, false_alarms=0.01),
        Kind.BARRIER: Target(peak=0.99, half_m=65.0, false_alarms=0.01),
        Kind.POTHOLE: Target(peak=0.85, half_m=14.0, false_alarms=0.02),
    },
    weather={
        "clear": _SAME,
        "rain": Effect(reach=0.80, peak=0.96, false_alarms=1.5, pothole=0.80),
        "fog": Effect(reach=0.28, peak=0.93, false_alarms=3.0, pothole=0.90),
        "snow": Effect(reach=0.60, peak=0.92, false_alarms=3.0, pothole=0.40),
    },
    light=_BY_DAY_AND_NIGHT,
)
"""A spinning lidar on the roof."""

RADAR: Final = SensorSpec(
    name="radar",
    number=3,
    range_m=150.0,
    view_deg=120.0,
    along=0.004,
    across_deg=1.5,
    wrong_heading=0.02,
    targets={
        Kind.VEHICLE: Target(peak=0.97, half_m=110.0, false_alarms=0.03),
        Kind.PEDESTRIAN: Target(peak=0.85, half_m=40.0, false_alarms=0.02),
        Kind.BARRIER: Target(peak=0.93, half_m=90.0, false_alarms=0.03),
        Kind.POTHOLE: Target(peak=0.05, half_m=5.0, false_alarms=0.01),
    },
    weather={
        "clear": _SAME,
        "rain": Effect(reach=0.85, peak=0.98, false_alarms=1.3),
        "fog": Effect(reach=0.98, peak=1.0, false_alarms=1.0),
        "snow": Effect(reach=0.90, peak=0.97, false_alarms=1.2),
    },
    light=_BY_DAY_AND_NIGHT,
)
"""A front radar."""

SUITES: Final[Mapping[str, tuple[SensorSpec, ...]]] = {
    "camera": (CAMERA,),
    "lidar": (LIDAR,),
    "radar": (RADAR,),
    "fusion": (CAMERA, LIDAR, RADAR),
}
"""The devices behind each sensor that can be chosen; `fusion` carries all three."""

FORGETTING: Final = 0.03
"""Chance in a tick that a mover is not where the rule of motion expects it: it reacted to the vehicle, or to
something that is not believed to be there. A judgement, checked by `tools/sensor_calibration.py`."""

MAX_REACH: Final = 40
"""Rows ahead that are looked at, at most, however small the cells are."""

"""Types of the library; `help(docent.NAME)` says units, shapes and frames."""
import os
from collections.abc import Callable, Iterable, Sequence
from types import SimpleNamespace
from typing import Any, ClassVar, overload

import numpy
import numpy.typing

_Array = numpy.typing.NDArray[Any]
_Points = numpy.typing.ArrayLike
_Path = str | os.PathLike[str]
_Point = Point2 | tuple[float, float]
_Pose = Pose2 | tuple[float, float, float]

kRangeBins: int
kNoReturn: int
kUnknownRange: int
kExpectedRanges: int


# Geometry and time.

class Point2:
    x: float
    y: float
    @overload
    def __init__(self, x: float = 0.0, y: float = 0.0) -> None: ...
    @overload
    def __init__(self, pair: tuple[float, float]) -> None: ...
    def __eq__(self, other: object) -> bool: ...


class Pose2:
    x: float
    y: float
    @property
    def theta(self) -> float: ...
    @overload
    def __init__(self, x: float = 0.0, y: float = 0.0, theta: float = 0.0) -> None: ...
    @overload
    def __init__(self, all: tuple[float, float, float]) -> None: ...
    def position(self) -> Point2: ...
    @overload
    def __mul__(self, other: _Pose) -> Pose2: ...
    @overload
    def __mul__(self, other: _Point) -> Point2: ...


class Time:
    nanoseconds: int
    def __init__(self, nanoseconds: int = 0) -> None: ...
    def __eq__(self, other: object) -> bool: ...
    def __lt__(self, other: Time) -> bool: ...
    def __le__(self, other: Time) -> bool: ...


def inverse(a_from_b: _Pose) -> Pose2: ...
def to_seconds(time: Time) -> float: ...
def time_from_seconds(value: float) -> Time: ...


# Maps.

class GridFrame:
    columns: int
    rows: int
    resolution: float
    origin: Point2
    def __init__(self, columns: int, rows: int, resolution: float = 0.05, origin: _Point = ...) -> None: ...
    def cell_at(self, in_map: _Point) -> tuple[int, int]: ...
    def centre(self, cell: tuple[int, int]) -> Point2: ...
    def extent(self) -> tuple[float, float, float, float]: ...


class OccupancyGrid:
    kUnknown: ClassVar[int]
    kFree: ClassVar[int]
    kOccupied: ClassVar[int]
    frame: GridFrame
    cells: _Array
    def __init__(self, cells: _Array, resolution: float = 0.05, origin: _Point = ...) -> None: ...


class RayCaster:
    def __init__(self, map: OccupancyGrid) -> None: ...
    def cast(self, origin: _Point, headings: _Array, max_range: float, unknown_allowance: float = 0.3) -> _Array: ...
    def clearance(self, in_map: _Point) -> float: ...
    def frame(self) -> GridFrame: ...


def load_map(yaml: _Path) -> OccupancyGrid: ...
def save_map(map: OccupancyGrid, path_without_extension: _Path) -> None: ...
def map_hash(map: OccupancyGrid) -> str: ...
def coarsened(map: OccupancyGrid, factor: int) -> OccupancyGrid: ...
def distance_transform(frame: GridFrame, occupied: _Array) -> _Array: ...


# Sensors.

class LaserReading:
    ranges: _Array
    first_bearing: float
    bearing_step: float
    min_range: float
    max_range: float
    def __init__(self, ranges: _Array, first_bearing: float, bearing_step: float, min_range: float = 0.02,
                 max_range: float = 10.0) -> None: ...


class RangeSweep:
    beams: _Array
    def __init__(self) -> None: ...
    def append(self, reading: LaserReading, base_from_sensor: _Pose = ...) -> None: ...
    def __len__(self) -> int: ...


class ReadingCounts:
    def __init__(self, max_range: float) -> None: ...
    def add(self, measured: _Array, expected: _Array) -> int: ...
    def total(self) -> int: ...


class ProximityFit:
    params: ProximityModelParams
    readings: int
    before: float
    after: float
    history: _Array


class ProximityModel:
    def __init__(self, params: ProximityModelParams = ...) -> None: ...
    def bin(self, range: float) -> int: ...
    def lower_edge(self, bin: int) -> float: ...
    def centre(self, bin: int) -> float: ...
    def probability(self, measured: int, expected: int) -> float: ...
    def probabilities(self) -> _Array: ...


def seen_from(sweep: RangeSweep, there_from_here: _Pose) -> RangeSweep: ...
def fit_proximity_model(counts: ReadingCounts, start: ProximityModelParams, *, least_readings: float = 2000.0,
                        most_rounds: int = 100) -> ProximityFit: ...
def mean_log_likelihood(counts: ReadingCounts, params: ProximityModelParams) -> float: ...


# Logs.

class LoggedScan:
    time: Time
    rear: bool
    first_bearing: float
    bearing_step: float
    ranges: _Array
    odom_from_base: Pose2
    base_from_laser: Pose2
    logged_pose: Pose2
    line: int


class LoggedOdometry:
    time: Time
    odom_from_base: Pose2
    linear: float
    angular: float


class LoggedPing:
    time: Time
    sonar: int
    range: float
    odom_from_base: Pose2


class LaserLog:
    scans: list[LoggedScan]
    odometry: list[LoggedOdometry]
    pings: list[LoggedPing]
    base_from_sonar: _Array
    sonar_max_range: float
    parameters: dict[str, str]
    max_range: float
    times_are_invented: bool
    sources: str
    notes: list[str]
    def __len__(self) -> int: ...


def read_laser_log(path: _Path, with_sonars: bool = False, scans: list[str] = ..., odometry: str = "", robot: str = "") -> LaserLog: ...
def read_carmen_log(path: _Path) -> LaserLog: ...
def sweep_of(scan: LoggedScan, max_range: float) -> RangeSweep: ...


# Museums.

class Hazard:
    id: str
    kind: str
    polygon: _Array


class Exhibit:
    id: str
    title: dict[str, str]
    pose: Pose2
    look_at: Point2
    topics: list[str]
    web_only: bool


class Museum:
    folder: os.PathLike[str]
    name: dict[str, str]
    languages: list[str]
    map: OccupancyGrid
    area: _Array
    hazards: list[Hazard]
    home: Pose2
    charger: Pose2 | None
    exhibits: list[Exhibit]
    def hazard_polygons(self) -> list[_Array]: ...


def load_museum(folder: _Path) -> Museum: ...


# Localization.

class BeliefMode:
    map_from_robot: Pose2
    covariance: _Array
    mass: float
    def __init__(self, map_from_robot: _Pose, covariance: _Points, mass: float = 1.0) -> None: ...


class BeliefSummary:
    cells: _Array
    rest_origin: Point2
    rest_cell_size: float
    rest: _Array
    modes: list[BeliefMode]
    entropy: float
    active_mass: float
    active_states: int


class PositionDensity:
    frame: GridFrame
    mass: _Array


class Doubt:
    mass: float
    share: float
    confirmation: float
    agreement: float
    contradiction: float
    surprise: float
    hidden: float
    unmapped: float
    spread: float


class Verdict:
    def localized(self) -> bool: ...
    def keeps_its_place(self) -> bool: ...
    def p_lost(self) -> float: ...
    def contradicted(self) -> bool: ...
    def startled(self) -> bool: ...
    def doubt(self) -> Doubt: ...


class Step:
    updated: bool
    beams_used: int
    beams_filtered: int
    weight: float
    fit: float | None


class Localizer:
    def start_unknown(self) -> None: ...
    def start_at(self, modes: Sequence[BeliefMode], odom_from_robot: _Pose, time: Time) -> None: ...
    def observe(self, sweep: RangeSweep, odom_from_robot: _Pose, time: Time) -> Step: ...
    def summary(self) -> BeliefSummary: ...
    def verdict(self) -> Verdict: ...
    def density(self) -> PositionDensity: ...
    def map_from_robot(self, odom_now: _Pose) -> Pose2 | None: ...
    def entropy_gains(self, sweep: RangeSweep, odom_now: _Pose) -> _Array: ...


class MarkovLocalizer(Localizer):
    def __init__(self, map: OccupancyGrid, params: LocalizerParams = ..., *, closed: Iterable[_Points] = (),
                 cache: _Path = "", seed: int = 1) -> None: ...


class ParticleSet:
    x: _Array
    y: _Array
    heading_x: _Array
    heading_y: _Array
    weight: _Array
    def size(self) -> int: ...
    def __len__(self) -> int: ...


class MonteCarloLocalizer(Localizer):
    def __init__(self, map: OccupancyGrid, shared: LocalizerParams = ..., params: MonteCarloParams = ..., *,
                 closed: Iterable[_Points] = (), cache: _Path = "", seed: int = 1) -> None: ...
    def particles(self) -> ParticleSet: ...


# Planning.

class ValueIteration:
    def __init__(self, frame: GridFrame) -> None: ...
    def set_costs(self, costs: _Array) -> None: ...
    def set_goals(self, goals: Sequence[tuple[int, int]]) -> None: ...
    def iterate(self, most_visits: int = ...) -> bool: ...
    def is_settled(self) -> bool: ...
    def values(self) -> _Array: ...
    def descend(self, start: tuple[int, int]) -> _Array: ...
    def frame(self) -> GridFrame: ...


class RoutePlanner:
    def __init__(self, map: OccupancyGrid, hazards: Iterable[_Points] = (), area: _Points = (),
                 params: RouteParams = ...) -> None: ...
    def set_obstacles(self, obstacles: _Array, settled: _Array | None = None) -> None: ...
    def set_goals(self, goals: _Points, tolerance: float = 0.1) -> None: ...
    def iterate(self, most_visits: int = ...) -> bool: ...
    def settle(self, start: _Point, most_visits: int = ...) -> bool: ...
    def hold_way(self, start: _Point) -> None: ...
    def way(self, start: _Point) -> _Array: ...
    def cost_from(self, start: _Point) -> float: ...
    def is_closed(self, in_map: _Point) -> bool: ...
    def values(self) -> _Array: ...
    def static_costs(self) -> _Array: ...
    def frame(self) -> GridFrame: ...


# Virtual measurements.

class VirtualScan:
    ranges: _Array
    possible_mass: float


class VirtualMeasurements:
    kDirections: ClassVar[int]
    kMaxRange: ClassVar[float]
    def __init__(self, area: _Points, hazards: Iterable[_Points], params: VirtualMeasurementParams = ...,
                 ends: str = "both") -> None: ...
    @overload
    def measure(self, belief: BeliefSummary) -> VirtualScan: ...
    @overload
    def measure(self, poses: _Points) -> VirtualScan: ...
    def is_possible(self, position: _Point) -> bool: ...
    def nearest(self, position: _Point) -> float: ...


# Mapping.

class MapJudgement:
    pairs: int
    in_conflict: float
    mean_conflict: float
    expected_error: float
    odometry_scale: float
    is_trusted: bool
    reason: str


class LogMap:
    map: OccupancyGrid
    scans: list[int]
    map_from_base: _Array
    loops: int
    revisits: int
    revisit_error: float
    judgement: MapJudgement


def map_log(log: LaserLog, params: ScanMapperParams | None = None, *, way: float = 0.15, turn: float = 8.0,
            progress: Callable[[str, int, int], object] | None = None) -> LogMap: ...


# Recordings.

class McapMessage:
    topic: str
    type: str
    log_time: Time
    publish_time: Time
    data: bytes
    def decode(self) -> SimpleNamespace: ...


class McapReader:
    @staticmethod
    def open(path: _Path) -> McapReader: ...
    def profile(self) -> str: ...
    def is_complete(self) -> bool: ...
    def message_count(self) -> int | None: ...
    def counts_by_topic(self) -> dict[str, int]: ...
    def types_by_topic(self) -> dict[str, str]: ...
    def damage(self) -> list[str]: ...
    def read(self, handler: Callable[[McapMessage], bool], *, topics: set[str] = ..., from_: Time | None = None,
             to: Time | None = None, skip_damaged: bool = False) -> None: ...
    def messages(self, *, topics: set[str] = ..., from_: Time | None = None, to: Time | None = None,
                 skip_damaged: bool = False) -> list[McapMessage]: ...


# Parameters: the C++ headers say unit, range and reason of each.

class Clearance:
    walls: float
    hazards: float
    border: float
    def __init__(self, **fields: Any) -> None: ...


class ProximityModelParams:
    max_range: float
    sigma: float
    sigma_per_metre: float
    short_per_metre: float
    weight_hit: float
    weight_near: float
    near_factor: float
    weight_short: float
    weight_no_return: float
    weight_random: float
    def __init__(self, **fields: Any) -> None: ...


class OdometryModelParams:
    translation_per_metre: float
    translation_per_radian: float
    rotation_per_metre: float
    rotation_per_radian: float
    slip_probability: float
    def __init__(self, **fields: Any) -> None: ...


class StateSpaceParams:
    wall_depth: float
    cell_size: float
    heading_step: float
    min_clearance: float
    def __init__(self, **fields: Any) -> None: ...


class VerdictParams:
    here: float
    no_longer_here: float
    given_up: float
    enough_share: float
    enough_mass: float
    too_little_mass: float
    widest_spread: float
    confirmations: float
    travelled: float
    turned: float
    least_agreement: float
    blind_way: float
    most_contradiction: float
    startled_through: float
    startled_hidden: float
    def __init__(self, **fields: Any) -> None: ...


class PoseRefinerParams:
    enabled: bool
    gate: float
    beam_sigma: float
    independent_beams: float
    farthest: float
    farthest_turn: float
    def __init__(self, **fields: Any) -> None: ...


class TracksParams:
    spacing: float
    turned: float
    most_views: int
    most_tracks: int
    beams: int
    nats: float
    part: float
    wall_part: float
    first_short: float
    too_short: float
    part_beams: float
    hopeless: float
    given: float
    followed: float
    carried_off: float
    startled: float
    startled_given: float
    most_heard: float
    search_way: float
    search_way_kept: float
    search_way_calm: float
    doubt_nats: float
    usual_nats: float
    def __init__(self, **fields: Any) -> None: ...


class LocalizerParams:
    states: StateSpaceParams
    sensor: ProximityModelParams
    motion: OdometryModelParams
    verdict: VerdictParams
    refiner: PoseRefinerParams
    tracks: TracksParams
    beams: int
    independent_beams: float
    independent_beams_far: float
    sectors: int
    most_sector_nats: float
    most_sector_nats_lost: float
    filter: str
    filter_sureness: float
    unfiltered_share: float
    person_share: float
    sea_threshold: float
    teleport_probability: float
    teleport_in_doubt: float
    update_way: float
    update_turn: float
    creeping_period: float
    standing_period: float
    standing_weight: float
    exact_walls: bool
    most_views: float
    most_nats: float
    most_nats_far: float
    focus_radius: float
    focus_turn: float
    focus_deviations: float
    most_states_asked: int
    work_per_second: float
    simd: str
    def __init__(self, **fields: Any) -> None: ...


class KldParams:
    cell_size: float
    heading_step: float
    error: float
    quantile: float
    def __init__(self, **fields: Any) -> None: ...


class LikelihoodFieldParams:
    sigma: float
    near_scale: float
    weight_hit: float
    weight_near: float
    weight_random: float
    def __init__(self, **fields: Any) -> None: ...


class MonteCarloParams:
    model: str
    least: int
    most: int
    reserve: int
    kld: KldParams
    field: LikelihoodFieldParams
    shake_position: float
    shake_heading: float
    resample_below: float
    deprived: float
    surprise_slow: float
    surprise_fast: float
    draw_every: int
    def __init__(self, **fields: Any) -> None: ...


class RouteParams:
    coarsening: int
    robot_radius: float
    clearance: Clearance
    comfort: float
    comfort_cost: float
    obstacle_cost: float
    obstacle_margin: float
    obstacle_comfort: float
    obstacle_comfort_cost: float
    settled_cost: float
    settled_closed: bool
    lane_width: float
    lane_cost: float
    switch_gain: float
    aside: float
    def __init__(self, **fields: Any) -> None: ...


class VirtualMeasurementParams:
    confidence: float
    jointly: bool
    cell_padding: float
    max_impossible: float
    doubt_sigmas: float
    def __init__(self, **fields: Any) -> None: ...


class ScanMapperParams:
    resolution: float
    hit: float
    pass_: float
    most_log_odds: float
    reach: float
    margin: float
    empty_reach: float
    widest_gap: float
    widest_wall: float
    border: float
    occupied: float
    free: float
    most_free_pieces: float
    fewest_hits: int
    def __init__(self, **fields: Any) -> None: ...

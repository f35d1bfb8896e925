"""What can be asked about: the names of the kinds of question, and of what each asks for."""

from __future__ import annotations

from typing import Literal

MetricName = Literal["crashes", "successes", "success_rate", "steps", "moves", "distance", "speed"]
QuestionName = Literal[
    "why",
    "why_not",
    "what_if",
    "next",
    "scene",
    "status",
    "metrics",
    "confidence",
    "maintenance",
    "help",
    "setting",
    "options",
    "term",
    "fact",
    "history",
    "styles",
    "changes",
    "pending",
    "detail",
    "other",
    "pattern",
    "outlook",
    "blame",
    "planners",
    "quiz",
    "rules",
    "sight",
    "world",
]
OutlookName = Literal[
    "safe",
    "arrival",
    "crash",
    "arrive_how",
    "stuck",
    "avoid_how",
    "way",
    "wait",
    "free",
    "matters",
    "risk",
    "coming",
    "safest",
    "next_stop",
    "next_change",
    "others",
    "crossing",
    "gaps",
    "danger",
    "worst",
    "lane",
    "liable",
    "others_next",
    "stays_free",
    "place_then",
    "best_way_here",
]
"""What of the time ahead is asked about.

`way`: whether any way leads to the goal; `wait`: how long the vehicle stays where it is;
`free`: which moves meet nothing now; `matters`: what the coming move hangs on; `risk`: how safe it is now;
`coming`: what happens in the next ticks or seconds; `safest`: which move is; `next_stop`,
`next_change`: when the vehicle will next stop or change lanes; `others`: where the cars and people on foot
go, or those of a kind; `crossing`: which of them come into the lane ahead of the vehicle;
`gaps`: what the next rows of barriers leave free;
`danger`: what is most dangerous now, of all or of a kind; `worst`: what may come at worst in some ticks;
`lane`: why it does not take a lane, and what would come of that; `liable`: whose a crash would be now;
`others_next`: what the others do in the very next tick, or those of a kind; `stays_free`: for how many ticks
the space ahead or beside stays free; `place_then`: in which lane and row the vehicle will be, or was, at a
tick or after some; `best_way_here`: the quickest way to the goal from now.
"""
BlameName = Literal[
    "fault",
    "too_late",
    "foreseen",
    "avoidable",
    "human",
    "first_seen",
    "the_other",
    "other_could",
    "rules",
    "bug",
    "factor",
    "expected",
    "entered",
]
"""What about a crash is asked.

`human`: whether a person would have crashed; `first_seen`: since when what was hit was seen; `the_other`:
where what was hit came from, and how fast; `other_could`: whether it could have kept clear; `rules`: what
part the planner's own rules had; `bug`: whether the program did other than its rules say; `factor`: which one
of sensor, weather and planner, replaced alone, would have led to the goal; `expected`: what was expected of
what was hit; `entered`: why its cell was entered.
"""
PlannerFactName = Literal[
    "lookahead",
    "ties",
    "replanning",
    "precedence",
    "costs",
    "halts",
    "prediction",
    "heuristic",
    "no_way",
]
"""What is asked of how a planner decides always.

`lookahead`: how far ahead; `ties`: among equals; `replanning`: how often; `precedence`: in what order it
tries moves; `costs`: what costs what; `halts`: when it waits; `prediction`: whether it knows where others go;
`heuristic`: what bounds its search; `no_way`: what it does where no way leads to the goal.
"""
PlannersName = Literal[
    "here",
    "compare",
    "character",
    "ranked",
    "own",
    "method",
    "often",
    "difference",
    "effort",
    "parting",
    "hand_beside",
    "plan",
    "plan_changes",
    PlannerFactName,
]
"""What about planners is asked.

`ranked`: how all of them drive on many roads; `own`: what this session's would have done where a person
drove; `method`: by what it chooses; `often`: how often it arrives, crashes and gets stuck; `difference`: how
some differ in general; `effort`: how much a search looks at; `parting`: where two first decide otherwise on
this road; `hand_beside`: where it would be now, had it driven in place of a person; `plan`: what was planned
at a tick; `plan_changes`: how often what was left of a plan was given up.
"""
HistoryName = Literal[
    "closest_call",
    "summary",
    "since",
    "between",
    "seen",
    "riskiest",
    "similar",
    "choices",
    "losses",
    "runner_up",
    "scores",
    "waited",
    "differed",
    "before_crash",
    "lane_changes",
    "passed",
    "verdict",
    "needed",
    "stopped",
    "lanes_used",
    "tight",
    "made",
    "ended",
    "first_half",
    "second_half",
    "sighted",
    "overlooked",
    "lost_sight",
    "noticed",
    "shares",
    "moving",
    "listed",
    "in_the_way",
    "advanced",
    "end",
    "near_misses",
    "move_risk",
    "average_speed",
    "way_share",
    "best_time",
    "straight_line",
    "luck",
    "started",
    "hand_since",
    "stuck_cause",
    "knowable",
    "influence",
    "trouble",
    "explained",
    "unsafe_moves",
    "last_detected",
    "places_before",
    "least_ttc",
    "smoothness",
    "reversals",
    "nearest_goal",
    "here_since",
    "not_advanced",
    "story",
    "mishaps",
    "typical",
    "late",
    "best_way",
    "chosen_safest",
]
"""What of the past is asked about: of this episode, of the ticks since one, between two, or of one tick.

`choices`: the moves of a decision, and what each would have met; `losses`: what the decisions of this episode
have cost against the quickest way; `runner_up`: the second best move of a decision; `scores`: what it made of
each move; `waited`: how long the ego has waited; `differed`: moves of a person that the planner would not
have made; `before_crash`: what was hit, and the ego, in the last ticks before the latest crash;
`lane_changes`: how often it changed lanes; `passed`: what it has left behind; `verdict`: how well it went;
`needed`: whether a move was needed, the latest that was not straight on by default; `stopped`: how often it
stopped, and what for; `lanes_used`: for how long it was in each lane; `tight`: ticks with one free move or
none; `made`: how often it made a move; `ended`: how episodes of the session ended; `first_half`,
`second_half`: of the present drive so far, or of all of it once it has ended; `sighted`: since when a thing
is detected, or the things of a kind, or all; `overlooked`: what was driven past and never detected;
`lost_sight`: what was detected ahead and then was not; `noticed`: what is detected at a tick and was not at
the one before; `shares`: how many moves of each kind were made;
`moving`: the stretches without a stop; `listed`: the moves in their order; `in_the_way`: the moves other than
straight on that were for something; `advanced`: how many rows it came ahead; `end`: how, when and where the
drive ended; `near_misses`: what came that close that it nearly met; `move_risk`: how near a move came to what
moves, the latest by default; `average_speed`: of this drive; `way_share`: what part of the way to the goal
is driven; `best_time`: the least time in which this road can be driven; `straight_line`: how much longer than
straight ahead it drove; `luck`: how the same drive goes with other chances; `started`: where it
began; `hand_since`: since when a person drives, and which of its moves were held back; `stuck_cause`: why it
got stuck; `knowable`: when it could have been known that no way was left;
`influence`: whether others braked or turned because of it; `trouble`: what its moves hung on most;
`explained`: the last moves, each with its reason; `last_detected`: how long ago what is believed was last
detected, the oldest by default; `places_before`: where a thing was in the last ticks, or what was hit before
the crash; `least_ttc`: the least time to collision; `smoothness`: lane changes, stops and turns to the other
side for its way; `reversals`: whether it went left and right by turns; `nearest_goal`: whether it was ever
nearer to the goal; `here_since`: since when it is in this cell and this lane; `not_advanced`: the ticks
in which it came no row ahead; `story`: what happened, in order; `mishaps`: what went wrong, in order;
`unsafe_moves`: moves of a person that the rules forbid; `typical`: this drive beside others of the same
settings on other roads; `late`: what was near when it was first detected; `best_way`: the quickest way from
where the drive began; `chosen_safest`: whether a move was the safest, the latest by default.
"""
WantName = Literal["list", "first", "last", "longest", "whether", "share"]
"""What is wanted of what is counted; a count where it is not said. `share`: of the time."""
PartName = Literal["first_half", "second_half", "session"]
"""A stretch that is named without ticks, in place of the present episode."""
DeviceFactName = Literal[
    "failure",
    "look_rate",
    "speeds",
    "all_round",
    "own_place",
    "evenness",
    "kinds_apart",
    "standing",
]
"""What is asked of sensors and holds always.

`failure`: whether they break down; `look_rate`: how often they look; `speeds`: whether they measure speed;
`all_round`: whether they see to the sides and behind; `own_place`: how the ego knows where it is; `evenness`:
whether the weather is the same everywhere; `kinds_apart`: whether kinds of things are told apart; `standing`:
whether what stands is seen.
"""
SightName = Literal[
    "phantoms",
    "missed",
    "truth",
    "range",
    "blind",
    "weather",
    "care",
    "weathers",
    "sensors",
    "memory",
    "unseen",
    "detection",
    "combining",
    "prevents",
    "sensor_fault",
    "limits",
    "model",
    "coping",
    "sensor_choice",
    "belief",
    "effect",
    "errors",
    "cell",
    "unknown",
    "would_see",
    "by_device",
    "first_device",
    "cell_entered",
    "placing",
    "grid_doubt",
    "alarm_moves",
    DeviceFactName,
]
"""What about sensing is asked.

`truth`: what is really there; `blind`: whether it drives blind; `weather`: whether the weather made a
difference; `care`: whether it drives otherwise in bad weather; `weathers`, `sensors`: which is best or worst;
`memory`: whether it remembers what it saw; `unseen`: what a cell out of sight counts as; `detection`: how
surely each sensor detects a kind of things; `combining`: how several devices become one belief; `prevents`:
which sensor would have led to the goal; `sensor_fault`: whether the sensor is to blame; `limits`: whether
weather or light limits it more; `model`: how weather and light are simulated; `coping`: how it drives where
little is seen; `sensor_choice`: who chose the sensor; `belief`: how sure it is of the nearest thing, which
device saw that, and whether it is there; `effect`: what weather and light do to a sensor; `errors`: in how
many ticks what was seen was what was there; `cell`: how sure it is that the cell of a move is free;
`unknown`: which cells ahead no device sees; `would_see`: whether another sensor would see the nearest thing;
`by_device`: what camera, lidar and radar each report now, or one of them alone; `first_device`: which of them
saw a thing first; `cell_entered`: how sure it was of the cell that it entered; `placing`: how exactly things
are placed; `grid_doubt`: why the grid is uncertain; `alarm_moves`: which moves a false alarm caused.
"""
WorldRuleName = Literal[
    "moves",
    "movers",
    "weights",
    "learning",
    "nature",
    "sources",
    "by_hand",
    "giving_up",
]
"""What is asked of this world and holds in every drive.

`moves`: which moves there are; `movers`: how cars and people move; `weights`: whether a person counts more
than a car; `learning`: whether it learns; `nature`: whether it feels; `sources`: where answers come from;
`by_hand`: what happens while a person drives; `giving_up`: when a drive counts as stuck.
"""
WorldFactName = Literal[
    "tick_order",
    "sharing",
    "fixtures",
    "slippery",
    "endings",
    "road_made",
    "realism",
    "constancy",
    "contact",
    "points",
    "behind",
    "obstacles",
    "heed",
    "goal",
    "diagonal",
]
"""What is asked of how this world is made.

`tick_order`: who moves first; `sharing`: whether others collide; `fixtures`: traffic lights, horns and the
like; `endings`: what follows an end; `road_made`: how roads are drawn; `constancy`: whether the weather
changes; `contact`: what counts as a crash; `points`: whether there are any; `behind`: whether anything comes
from behind; `obstacles`: what sets barriers and potholes apart, and whether they move or can be passed;
`heed`: whether others see the ego and react to it; `goal`: what the goal is, and who says that it is reached;
`diagonal`: whether a diagonal move is faster.
"""
SessionFactName = Literal[
    "picture",
    "hand_sight",
    "holes",
    "export",
    "switching",
    "stepping",
    "emergency",
    "traffic_rules",
    "runs_needed",
    "keys",
    "counting",
    "path_view",
    "log_line",
]
"""What is asked of the simulator around a drive.

`picture`: why pictures show more than is seen; `hand_sight`: what a person who drives sees; `holes`: whether
a pothole may be driven over; `export`: how a drive is saved; `switching`: what can be set during a drive;
`stepping`: whether one can go back to a tick; `emergency`: why there is no emergency braking;
`traffic_rules`: whether one was broken; `runs_needed`: how many runs a claim about a rate takes; `keys`:
which keys drive; `counting`: what the figures of a session count, and whether drives by hand are among them;
`path_view`: what the path that the page draws shows, and why there is none; `log_line`: what a line of the
log means.
"""
HandFactName = Literal["hand_time", "hand_warning", "hand_plan", "hand_blame"]
"""What is asked of driving by hand.

`hand_time`: whether time runs on without a key; `hand_warning`: whether a crash is warned of; `hand_plan`:
what the planner does meanwhile, and whose plan is drawn; `hand_blame`: whose a crash is.
"""
WorldTruthName = Literal[
    "real_car",
    "general_safety",
    "safety_gear",
    "car_talk",
    "rule_makers",
    "all_lanes",
]
"""What is asked of this world beside the real one, and of its road.

`real_car`: what a real self-driving car would do; `general_safety`: whether such cars are safe;
`safety_gear`: airbags, seat belts, a call for help; `car_talk`: whether cars tell each other anything;
`rule_makers`: who made the rules; `all_lanes`: whether all lanes may be used.
"""
WorldName = Literal[
    "pace",
    "gap",
    "stopping",
    "right_of_way",
    "harm",
    "chance",
    "colours",
    WorldRuleName,
    WorldFactName,
    SessionFactName,
    HandFactName,
    WorldTruthName,
]
"""What about this world and its rules is asked.

`pace`: how fast a move is; `gap`: the distance kept; `harm`: whether anybody was hurt; `chance`: whether the
same would happen again; `colours`: what the picture shows.
"""
OtherName = Literal["why", "going"]
"""What of another road user is asked about: why it did what it did, or where it goes."""
MomentName = Literal["detour"]
"""What moment is asked about, in place of a tick: the latest move to the side or diagonally."""
PolicyName = Literal["straight", "stand", "in_lane", "to_lane", "nonstop"]
"""By what rule it is supposed to drive: `straight`: forward in every tick; `stand`: staying in every tick;
`in_lane`: in one lane; `to_lane`: in the lane that is named, from the start; `nonstop`: without staying.
"""
SoonerName = Literal["sooner_stop", "sooner_change", "longer_wait", "unstopped"]
"""What is supposed of this drive so far: its latest stop or lane change a tick sooner, that stop a tick
longer, or forward in its place.
"""
PastMoveName = Literal["own_last"]
"""What move is supposed to have been another one: the latest that a person asked for."""
SoFarName = Literal["so_far"]
"""That a change of planner, sensor, weather or time of day is supposed of this drive since its start."""
SideName = Literal["other_side"]
"""The side opposite to that of the latest move to the side or diagonally."""
ScaleName = Literal["halved", "doubled"]
"""How many things of a kind there are supposed to be: half as many, or twice as many."""
SeedsName = Literal["other_seeds"]
"""Roads that are drawn alike from other seeds."""
DetailName = Literal["shorter", "longer", "why", "before", "after"]
"""How the last explanation is wanted again; before and after are the decisions next to it."""
Choosable = Literal["view", "preference", "road", "layout"]
"""What has options beside the parameters."""

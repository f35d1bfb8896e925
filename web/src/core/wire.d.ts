// Written by `make types-page` from the service's models; a change by hand is lost.

/** Typed actions. */
export interface Actions {
  type: "actions";
  /** Chosen by the client, given back with the answer. */
  id: string;
  actions: Action[];
  dry_run?: boolean;
  /** The past tick that is looked at: a question that names no tick of its own is asked of it, and the answer says which moment it is about. Orders are done now all the same. Default: now. */
  at_tick?: number | null;
  /** Chosen by the client: done once under this key, and answered the same for 24 hours. */
  key?: string | null;
}

/** Put `count` things of a kind on the road. */
export interface Add {
  do: "add";
  kind: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av";
  count: number;
  where?: Where | null;
}

/** Change a parameter by a factor, by a signed amount, or simply up or down. */
export interface Adjust {
  do: "adjust";
  parameter: "weather" | "time_of_day" | "traffic" | "planner" | "sensor" | "dynamics" | "playback_speed" | "target_speed_kmh" | "step_seconds" | "spawn_probability" | "pothole_probability" | "courtesy" | "attentive" | "sensor_noise" | "detection_sensitivity" | "false_positive_rate" | "sensor_latency" | "slip_probability" | "traffic_by_hour" | "sensor_range_m" | "safety_buffer" | "columns" | "rows" | "seed";
  factor?: number | null;
  by?: number | null;
  direction?: "up" | "down" | null;
}

/** What to do about a hazard ahead, how sure that is, and the physics behind it. */
export interface Advice {
  question: string;
  text: string;
  source: "typed" | "grammar" | "matched" | "llm";
  hazard: Kind;
  distance_m: number;
  speed_kmh: number;
  weather: "clear" | "rain" | "fog" | "snow";
  recommendation: Choice;
  /** Probability of coming away unharmed by doing so. */
  confidence: number;
  /** 95 % interval */
  interval: [number, number];
  options: AdviceOption[];
  physics: AdvicePhysics;
  parameters: AdviceQuantity[];
  samples: number;
  seed: number;
}

/** What one choice leads to. */
export interface AdviceOption {
  option: Choice;
  /** Probability of never reaching the hazard, or too slowly to be harmed. */
  chance: number;
  /** 95 % interval */
  interval: [number, number];
  /** With every quantity in the middle of its range. */
  ending: Ending;
  /** The distance in which it avoids the hazard. */
  needs_m: number;
  /** Speed at the hazard; 0: not reached. */
  meets_kmh: number;
  /** Mean speed at which harm is done; 0 counts where none is. */
  harm_kmh: number;
  /** Of a person on foot: mean published risk of death at the speed of impact; 0 for other hazards. */
  death: number;
}

/** The physics, with every quantity in the middle of its range. */
export interface AdvicePhysics {
  speed_ms: number;
  /** Until the hazard is reached if nothing is done. */
  time_s: number;
  reaction_s: number;
  friction: number;
  deceleration_ms2: number;
  reaction_m: number;
  braking_m: number;
  /** Reaction and braking: v·t + v²/(2·μ·g). */
  stopping_m: number;
  /** Enough to stop in 95 % of cases. */
  stopping_most_m: number;
  /** How far to move aside. */
  offset_m: number;
  lateral_ms2: number;
  /** To move that far aside: sqrt(2·y/a). */
  steering_s: number;
  /** Driven meanwhile, reaction included. */
  steering_m: number;
  /** Up to this speed the hazard can be driven over. */
  unharmed_kmh: number;
}

/** A number that the advice rests on, and its source. */
export interface AdviceQuantity {
  name: string;
  law: "lognormal" | "normal" | "fixed";
  /** Median, or mean of a normal quantity. */
  middle: number;
  /** Standard deviation; of the logarithm, where lognormal. */
  spread: number;
  unit: string;
  source: string;
}

/** A hazard ahead, as a sentence or in figures. */
export interface AdviceQuestion {
  /** As a sentence; then without hazard, distance and speed. */
  text?: string | null;
  hazard?: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av" | null;
  /** From 0.1 to 1,000. */
  distance_m?: number | null;
  /** From 1 to 300. */
  speed_kmh?: number | null;
  /** Default: clear. */
  weather?: "clear" | "rain" | "fog" | "snow" | null;
  /** In which language; `GET /language` names them. */
  language?: "en" | "de";
}

/** What to do about a hazard at a distance, at a speed. */
export interface Advise {
  do: "advise";
  hazard: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av";
  distance_m: number;
  speed_kmh: number;
}

/** The answer to a question; the facts it was made from depend on the question. */
export interface Answer {
  question: string;
  about: string;
  /** Ticks since the session began. */
  tick: number;
  text: string;
  [key: string]: unknown;
}

/** A question; which keys belong to which `about` is the contract's table. */
export interface Ask {
  do: "ask";
  about: "why" | "why_not" | "what_if" | "next" | "scene" | "status" | "metrics" | "confidence" | "maintenance" | "help" | "setting" | "options" | "term" | "fact" | "history" | "styles" | "changes" | "pending" | "detail" | "other" | "pattern" | "outlook" | "blame" | "planners" | "quiz" | "rules" | "sight" | "world";
  move?: Move | null;
  instead?: Move | null;
  tick?: number | null;
  change?: Action[] | null;
  kind?: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av" | null;
  metric?: "crashes" | "successes" | "success_rate" | "steps" | "moves" | "distance" | "speed" | null;
  parameter?: "weather" | "time_of_day" | "traffic" | "planner" | "sensor" | "dynamics" | "playback_speed" | "target_speed_kmh" | "step_seconds" | "spawn_probability" | "pothole_probability" | "courtesy" | "attentive" | "sensor_noise" | "detection_sensitivity" | "false_positive_rate" | "sensor_latency" | "slip_probability" | "traffic_by_hour" | "sensor_range_m" | "safety_buffer" | "columns" | "rows" | "seed" | "view" | "preference" | "road" | "layout" | null;
  value?: number | string | null;
  term?: "arrived" | "astar" | "attentive" | "av" | "barrier" | "bfs" | "camera" | "cautious" | "certificate" | "closest_call" | "columns" | "confidence" | "continuous" | "cooperative" | "courtesy" | "crash" | "detection_sensitivity" | "dijkstra" | "digest" | "dwa" | "dynamics" | "ego" | "episode" | "false_positive_rate" | "fastest" | "forecast" | "fusion" | "grid" | "layout" | "lidar" | "near_miss" | "occupancy" | "pedestrian" | "percept" | "perfect" | "planner" | "playback_speed" | "pothole" | "pothole_probability" | "preference" | "priority" | "radar" | "regret" | "rl" | "rows" | "rss" | "rules" | "safety_buffer" | "seed" | "sensor" | "sensor_noise" | "sensor_range_m" | "smooth_ride" | "avoid_potholes" | "spawn_probability" | "step_seconds" | "stuck" | "success_rate" | "target_speed_kmh" | "tick" | "time_of_day" | "traffic" | "ttc" | "vehicle" | "weather" | "what_if" | null;
  fact?: "after_goal" | "after_the_end" | "alarm_rate" | "arrows" | "asking_time" | "astar_bad" | "automation_level" | "barriers_placed" | "barriers_stay" | "behind_view" | "belief_age" | "belief_calibrated" | "belief_decides" | "belief_entropy" | "beside_real_cars" | "best_driver" | "best_figure" | "best_person" | "blocked_blame" | "body_sizes" | "break_through" | "camera_depth" | "camera_enough" | "cannot_answer" | "car_colour" | "car_damage" | "cars_sideways" | "cars_unmanned" | "cautious_style" | "cell_size" | "cell_update" | "cheating" | "cite_it" | "clock_time" | "comfort_minded" | "complete" | "complexity" | "courtesy_draw" | "crash_lessons" | "crash_on_purpose" | "critic" | "crossing_places" | "dark_and_others" | "dark_screen" | "decision_ms" | "default_planner" | "diagonal_risk" | "disengagement" | "distance_measure" | "doubt_planner" | "doubt_shown" | "doubt_to_planner" | "drive_at_all" | "drive_real_car" | "driving_test" | "earlier_drives" | "edge_lane" | "edge_of_road" | "empty_road_use" | "energy_use" | "error_kinds" | "evaluation_what" | "every_lane" | "first_look" | "flicker" | "fog_and_night" | "fog_strength" | "fog_vs_night" | "following_cars" | "fork_what" | "fusion_always" | "fusion_speed" | "gap_width" | "given_up_wrongly" | "goal_seen" | "good_result" | "greedy" | "greedy_search" | "grey_cells" | "grid_truth" | "hand_back" | "hand_feedback" | "hand_forecast" | "hand_hard" | "hand_in_log" | "hard_choices" | "headlamps" | "heuristic_fault" | "hide_views" | "how_many_drives" | "how_to_start" | "human_reaction" | "human_sight" | "imitation" | "in_hurry" | "independent_looks" | "interval_what" | "is_ai" | "judged_by" | "kalman_filter" | "key_timing" | "keyboard_only" | "knows_stuck" | "knows_weather" | "lane_liking" | "lane_marks" | "lane_speeds" | "language_model" | "languages" | "learned_eyes" | "left_to_chance" | "licence" | "livelock" | "local_minimum" | "log_evidence" | "log_warnings" | "longer_lookahead" | "look_before_change" | "makers" | "meant_to_crash" | "minimal_risk" | "misses_or_alarms" | "mistakes" | "mode_shown" | "momentum" | "money_matters" | "more_sensors" | "myopia" | "new_cars" | "no_images" | "no_oncoming" | "no_sight" | "noise_model" | "occlusion" | "odd" | "on_screen" | "one_drive" | "optimal_way" | "other_methods" | "other_road_users" | "other_weather" | "others_near" | "others_speed" | "others_stuck" | "own_planner" | "own_rules_broken" | "page_closed" | "panel_numbers" | "partial_path" | "passengers" | "people_clearance" | "people_looks" | "person_better" | "phone_drive" | "plan_memory" | "planner_better" | "planner_inputs" | "pothole_depth" | "pothole_sensing" | "predictable_cars" | "privacy_film" | "proof_of_no_way" | "purpose" | "quiet_road" | "quiz_is" | "race" | "radar_crossing" | "radar_holes" | "radar_in_cars" | "radar_real" | "radar_sideways" | "rain_strength" | "reactive" | "read_aloud" | "replay_exact" | "reversing" | "rings_marks" | "risk_figure" | "risk_or_stuck" | "road_flat" | "road_known" | "road_type" | "road_width" | "roadblock_news" | "roads_without_way" | "row_numbers" | "rules_cover" | "safety_guarantee" | "same_moves" | "same_roads" | "scenery" | "screen_text" | "scripts" | "sensor_delay" | "sensor_figures" | "sensor_pairs" | "sensor_random" | "session_what" | "seventh_move" | "several_av" | "sharing_link" | "showing_intent" | "small_in_fog" | "sounds" | "space_time" | "speech_in" | "standing_safe" | "star_name" | "start_tick" | "stats_conditions" | "stay_legal" | "stop_class" | "stop_for_people" | "stripes" | "stuck_fail" | "stuck_name" | "there_from_start" | "thing_names" | "thing_numbers" | "tick_react" | "timeline" | "traffic_jam" | "training" | "trap_on_purpose" | "two_as_one" | "typed_driving" | "undo_what" | "vehicle_looks" | "video_picture" | "view_centre" | "wait_to_look" | "wait_weather" | "walls_seen" | "warning_sign" | "weakness" | "weather_mix" | "weather_rates" | "weather_speed" | "weighted_astar" | "which_panel" | "who_pays" | "why_forward" | "why_rules" | "why_simulate" | "why_ticks" | "why_trust" | "without_sensor" | "wording" | "works_offline" | null;
  what?: "closest_call" | "summary" | "since" | "between" | "seen" | "riskiest" | "similar" | "choices" | "losses" | "runner_up" | "scores" | "waited" | "differed" | "before_crash" | "lane_changes" | "passed" | "verdict" | "needed" | "stopped" | "lanes_used" | "tight" | "made" | "ended" | "first_half" | "second_half" | "sighted" | "overlooked" | "lost_sight" | "noticed" | "shares" | "moving" | "listed" | "in_the_way" | "advanced" | "end" | "near_misses" | "move_risk" | "average_speed" | "way_share" | "best_time" | "straight_line" | "luck" | "started" | "hand_since" | "stuck_cause" | "knowable" | "influence" | "trouble" | "explained" | "unsafe_moves" | "last_detected" | "places_before" | "least_ttc" | "smoothness" | "reversals" | "nearest_goal" | "here_since" | "not_advanced" | "story" | "mishaps" | "typical" | "late" | "best_way" | "chosen_safest" | "why" | "going" | "safe" | "arrival" | "crash" | "arrive_how" | "stuck" | "avoid_how" | "way" | "wait" | "free" | "matters" | "risk" | "coming" | "safest" | "next_stop" | "next_change" | "others" | "crossing" | "gaps" | "danger" | "worst" | "lane" | "liable" | "others_next" | "stays_free" | "place_then" | "best_way_here" | "fault" | "too_late" | "foreseen" | "avoidable" | "human" | "first_seen" | "the_other" | "other_could" | "rules" | "bug" | "factor" | "expected" | "entered" | "here" | "compare" | "character" | "ranked" | "own" | "method" | "often" | "difference" | "effort" | "parting" | "hand_beside" | "plan" | "plan_changes" | "lookahead" | "ties" | "replanning" | "precedence" | "costs" | "halts" | "prediction" | "heuristic" | "no_way" | "detour" | "straight" | "stand" | "in_lane" | "to_lane" | "nonstop" | "sooner_stop" | "sooner_change" | "longer_wait" | "unstopped" | "other_side" | "halved" | "doubled" | "other_seeds" | "own_last" | "so_far" | "phantoms" | "missed" | "truth" | "range" | "blind" | "weather" | "care" | "weathers" | "sensors" | "memory" | "unseen" | "detection" | "combining" | "prevents" | "sensor_fault" | "limits" | "model" | "coping" | "sensor_choice" | "belief" | "effect" | "errors" | "cell" | "unknown" | "would_see" | "by_device" | "first_device" | "cell_entered" | "placing" | "grid_doubt" | "alarm_moves" | "failure" | "look_rate" | "speeds" | "all_round" | "own_place" | "evenness" | "kinds_apart" | "standing" | "pace" | "gap" | "stopping" | "right_of_way" | "harm" | "chance" | "colours" | "moves" | "movers" | "weights" | "learning" | "nature" | "sources" | "by_hand" | "giving_up" | "tick_order" | "sharing" | "fixtures" | "slippery" | "endings" | "road_made" | "realism" | "constancy" | "contact" | "points" | "behind" | "obstacles" | "heed" | "goal" | "diagonal" | "picture" | "hand_sight" | "holes" | "export" | "switching" | "stepping" | "emergency" | "traffic_rules" | "runs_needed" | "keys" | "counting" | "path_view" | "log_line" | "hand_time" | "hand_warning" | "hand_plan" | "hand_blame" | "real_car" | "general_safety" | "safety_gear" | "car_talk" | "rule_makers" | "all_lanes" | null;
  until?: number | null;
  ticks?: number | null;
  seconds?: number | null;
  count?: number | null;
  how?: "shorter" | "longer" | "why" | "before" | "after" | null;
  which?: Which | null;
  planners?: ("rules" | "priority" | "astar" | "dijkstra" | "bfs" | "exact" | "dwa" | "rl" | "cooperative")[] | null;
  planner?: "rules" | "priority" | "astar" | "dijkstra" | "bfs" | "exact" | "dwa" | "rl" | "cooperative" | null;
  want?: "list" | "first" | "last" | "longest" | "whether" | "share" | null;
  part?: "first_half" | "second_half" | "session" | null;
  lane?: number | null;
}

/** The first message of a socket where the service asks for a key: the key, or a ticket. */
export interface Auth {
  type: "auth";
  key?: string | null;
  ticket?: string | null;
}

/** A move that could not be made, and why. */
export interface BlockedMove {
  move: Move;
  reason: string;
  causes: string[];
}

/** A decision as a tick message tells it: of its options, only the blocked ones. */
export interface BriefDecision {
  /** Ticks since the session began. */
  tick: number;
  planner: string;
  move: Move;
  /** Why the preferred move was made, or what kept the ego from it. */
  reason: string;
  /** Ids of the things behind `reason`. */
  causes: string[];
  /** How much there is to say: 0 nothing was in the way, 1 a detour, 2 a wait or worse. */
  weight: 0 | 1 | 2;
  blocked: BlockedMove[];
}

/** Switch rules off: one by its number or place, all, the last, or those that do such an action. */
export interface Cancel {
  do: "cancel";
  which?: number | "all" | "last" | null;
  place?: number | null;
  doing?: string | null;
  kind?: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av" | null;
}

/** One value that differs. */
export interface Change {
  path: string;
  before: unknown;
  after: unknown;
}

/** A change that was accepted, whoever made it. */
export interface ChangedMessage {
  type: "changed";
  sequence: number;
  /** What was said; null for typed actions. */
  text: string | null;
  reply: string;
  changes: Change[];
  events: LogEvent[];
  state: State;
  /** Views to be shown (true) or hidden; absent where none is named. */
  views?: { [key: string]: boolean } | null;
  /** Id of the message, to resume after it. */
  event: string;
}

/** Small talk: one short line in return, and nothing else. */
export interface Chat {
  do: "chat";
  kind: "greeting" | "farewell" | "thanks" | "praise" | "apology" | "okay" | "complaint" | "identity" | "joke";
}

/** The choices, the one of least effort first. */
export type Choice = "keep" | "brake" | "steer" | "brake_and_steer";

/** One reading of an ambiguous sentence. */
export interface ChoiceModel {
  text: string;
  actions: Action[];
}

/** Something said. */
export interface Command {
  type: "command";
  /** Chosen by the client, given back with the answer. */
  id: string;
  text: string;
  dry_run?: boolean;
  language?: string | null;
  /** The past tick that is looked at: a question that names no tick of its own is asked of it, and the answer says which moment it is about. Orders are done now all the same. Default: now. */
  at_tick?: number | null;
  /** Chosen by the client: done once under this key, and answered the same for 24 hours. */
  key?: string | null;
}

/** What was done. */
export interface CommandResult {
  /** What was said; null for typed actions. */
  text: string | null;
  actions: Action[];
  changes: Change[];
  /** What was done, in a sentence or two. */
  reply: string;
  /** The answer, if something was asked. */
  answer: Answer | null;
  /** What understood it: the grammar, or a language model, which interprets. */
  source: "grammar" | "matched" | "llm" | "typed";
  sequence: number;
  corrections: Correction[];
  dry_run: boolean;
  /** Evaluations that it started, which go on in the background. */
  evaluations?: StartedEvaluation[];
}

/** What a rule waits for: one fact, with its figures. */
export interface Condition {
  fact: "crash" | "arrival" | "stuck" | "episode" | "move" | "every" | "after" | "tick" | "row" | "lane" | "standing" | "goal" | "near" | "count" | "weather" | "time_of_day";
  ticks?: number | null;
  seconds?: number | null;
  tick?: number | null;
  row?: number | null;
  lane?: "left" | "middle" | "right" | number | null;
  move?: "left" | "right" | "lane_change" | null;
  kind?: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av" | null;
  closer_than_m?: number | null;
  within_m?: number | null;
  farther_than_m?: number | null;
  side?: "ahead" | "behind" | null;
  at_least?: number | null;
  at_most?: number | null;
  weather?: "clear" | "rain" | "fog" | "snow" | null;
  time_of_day?: "day" | "dusk" | "night" | "dawn" | null;
  no_longer?: true | null;
}

/** What a patch of the configuration did. */
export interface ConfigChanged {
  changes: Change[];
  /** What was done, in a sentence or two. */
  reply: string;
  sequence: number;
}

/** Put another thing like it on the road, for each of some things: beside it, or where it is said. */
export interface Copy {
  do: "copy";
  kind: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av";
  count: number | "all";
  where?: Where | null;
  to?: Where | null;
}

/** A word that was read as another. */
export interface Correction {
  from: string;
  to: string;
}

/** The real run from a tick on, and the other. */
export interface Counterfactual {
  /** Ticks since the session began. */
  at_tick: number;
  /** The move that was made, where another is asked about. */
  instead_of: Move | null;
  /** How many actions were said after that tick. Neither run includes them. */
  said_since: number;
  real: Side;
  changed: Side;
  /** What differs, in a sentence or two. */
  text?: string;
  /** Where they first decide differently; null where they never do. */
  parting?: Parting | null;
}

/** What an ego crashed with. Met in one cell (`hit`), passing through one another (`swap`), or cut off on a diagonal (`cross`). */
export interface CrashCause {
  kind: Kind;
  how: "hit" | "swap" | "cross";
  ids: string[];
  /** [column, row], row 0 at the goal */
  cell: [number, number];
}

/** What was decided in the world of a tick; it leads to the next. */
export interface Decision {
  /** Ticks since the session began. */
  tick: number;
  planner: string;
  move: Move;
  /** The move that a person driving asked for. */
  asked: Move | null;
  options: Option[];
  narration: string;
  /** How much there is to say: 0 nothing was in the way, 1 a detour, 2 a wait or worse. */
  weight: 0 | 1 | 2;
}

/** Decisions, oldest first. Ticks at which a result stood have none. */
export interface DecisionPage {
  items: Decision[];
  /** Send as `after` for what follows. */
  after: number;
  more: boolean;
}

/** One move by a person, taken at the next tick that has none yet. */
export interface Drive {
  do: "drive";
  move: Move;
  ego?: string | null;
}

/** Drop the question that is pending, so that nothing answers it any more. */
export interface Drop {
  do: "drop";
}

/** How a run ends, if nothing more is said. */
export interface End {
  /** `running` where it is not told to its end. */
  outcome: Outcome;
  /** Ticks since the session began. */
  tick: number;
  /** Ticks on the road, without those waited for it. */
  driven: number;
  waited: number;
  /** Whether a person drives, who asked for nothing. */
  by_hand: boolean;
  cause: CrashCause | null;
  digest: string;
  /** The end in a few words. */
  text?: string;
}

/** The outcome of a choice with every quantity at its median or mean. */
export type Ending = "stops" | "clears" | "crosses" | "hits";

/** A message that could not be read, or a stream that cannot be opened. */
export interface ErrorMessage {
  type: "error";
  problem: ProblemDocument;
}

/** Many episodes, compared. */
export interface Evaluate {
  do: "evaluate";
  runs?: number | null;
  planners?: ("rules" | "priority" | "astar" | "dijkstra" | "bfs" | "exact" | "dwa" | "rl" | "cooperative")[] | null;
  scenario?: ScenarioParts | null;
  road?: "this" | null;
  scenario_name?: string | null;
  vary?: Varied | null;
  map?: ["potholes" | "vehicles" | "barriers" | "pedestrians", "potholes" | "vehicles" | "barriers" | "pedestrians"] | null;
}

/** An evaluation as it stands. */
export interface Evaluation {
  id: string;
  /** What it is: episodes that are compared, or a search for worlds that a planner fails. */
  kind: "evaluation" | "find_worst";
  state: "queued" | "running" | "done" | "failed" | "cancelled";
  created_at: string;
  /** What it runs, in words. */
  title: string;
  /** Episodes of each planner, or worlds that are searched. */
  runs: number;
  planners: string[];
  /** Episode (or world) i is drawn from this seed + i, for every planner. */
  seed: number;
  /** What the roads are drawn from; a search draws numbers of things and layouts itself. */
  config: { [key: string]: unknown };
  /** Whether all episodes start from one road: that of the session it was asked of, or of a scenario. */
  same_road: boolean;
  /** The scenario, or the moment that was saved, where one was named. */
  scenario_name: string | null;
  /** What is compared beside the planners, such as `{"weather": "fog"}`; empty where nothing is. */
  conditions: ({ [key: string]: unknown })[];
  /** Episodes of each planner that are done, under all conditions together; or worlds that are done. */
  done: number;
  /** The share of the work that is done. */
  progress: number;
  /** What came of it in plain language, once it is done. */
  text: string[] | null;
  /** The figures, once it is done. */
  result: { [key: string]: unknown } | null;
  /** Why it failed. */
  error: string | null;
  links: { [key: string]: string };
}

/** Evaluations, newest first. */
export interface EvaluationPage {
  items: EvaluationSummary[];
  after: string | null;
  more: boolean;
}

/** An evaluation in a list. */
export interface EvaluationSummary {
  id: string;
  /** What it is: episodes that are compared, or a search for worlds that a planner fails. */
  kind: "evaluation" | "find_worst";
  state: "queued" | "running" | "done" | "failed" | "cancelled";
  created_at: string;
  /** What it runs, in words. */
  title: string;
  /** The share of the work that is done. */
  progress: number;
  links: { [key: string]: string };
}

/** How the session's latest evaluation stands, its end before it is done, or who was better in it. */
export interface EvaluationTalk {
  do: "evaluation";
  want: "progress" | "cancel" | "better";
  planners?: ("rules" | "priority" | "astar" | "dijkstra" | "bfs" | "exact" | "dwa" | "rl" | "cooperative")[] | null;
}

/** Lines of the log, oldest first. */
export interface EventPage {
  items: LogEvent[];
  /** Send as `after` for what follows. */
  after: number;
  more: boolean;
  /** Lines before this number are no longer kept. */
  first_kept: number;
}

/** What is expected at a tick: what the ego is about to do, and where the movers will be. */
export interface Expected {
  /** Ticks since the session began. */
  tick: number;
  /** The decision taken at it; null where a result stands. */
  decision: Decision | null;
  /** Whether it is certain: false beyond the first tick where movers react to the ego. */
  exact: boolean;
  ahead: ExpectedTick[];
  /** The ego's own cells in the ticks to come, as many as were asked for, until its episode ends. It is driven on in the simulator, as if nobody said anything. */
  path?: ([number, number])[];
}

/** Where movers are expected to be at a tick to come. */
export interface ExpectedTick {
  /** Ticks since the session began. */
  tick: number;
  /** Their cells, by id. */
  movers: { [key: string]: [number, number] };
}

/** What is wrong with one field. */
export interface FieldProblemModel {
  field: string;
  message: string;
}

/** The world in which a planner fares worst. */
export interface FindWorst {
  do: "find_worst";
  runs?: number | null;
  planner?: "rules" | "priority" | "astar" | "dijkstra" | "bfs" | "exact" | "dwa" | "rl" | "cooperative" | null;
}

/** A taught phrase means nothing any more. */
export interface Forget {
  do: "forget";
  phrase: string;
}

/** A road, or a change of the present one, that is looked for and measured (`sim.goals`). */
export interface Goal {
  do: "goal";
  goal: "harder" | "easier" | "surprise" | "hard_but_solvable" | "separates" | "one_lane_free";
  planners?: ["rules" | "priority" | "astar" | "dijkstra" | "bfs" | "exact" | "dwa" | "rl" | "cooperative", "rules" | "priority" | "astar" | "dijkstra" | "bfs" | "exact" | "dwa" | "rl" | "cooperative"] | null;
  degree?: "little" | "lot" | null;
}

/** The session was deleted; the last message. */
export interface GoneMessage {
  type: "gone";
}

/** A pothole or a barrier. */
export interface Hazard {
  id: string;
  kind: "pothole" | "barrier";
  /** [column, row], row 0 at the goal */
  cell: [number, number];
}

/** The service is alive, and what it holds. */
export interface Health {
  status: "ok";
  version: string;
  sessions: number;
  watchers: number;
  tick_lateness: Lateness;
  /** Empty where one process holds all sessions. */
  shards?: ShardHealth[];
}

/** The first message of a connection: everything to begin with. */
export interface HelloMessage {
  type: "hello";
  /** Raised when a message changes its meaning; new keys do not raise it. */
  protocol: number;
  session: Session;
  state: State;
  /** The latest lines, oldest first. */
  log: LogEvent[];
  /** The latest decision. */
  decision: Decision | null;
  sequence: number;
  /** Id of the message, to resume after it. */
  event: string;
}

/** Hide a view. */
export interface Hide {
  do: "hide";
  view: "road" | "schematic" | "occupancy" | "plan" | "log" | "potholes" | "sensors" | "path" | "metrics";
}

/** One kind of thing that can be said. */
export interface IntentGuide {
  /** The action's `do`; for a question also what it is about. */
  intent: string;
  /** Whether this version does it. */
  available: boolean;
  why_not: string | null;
  examples: Saying[];
}

/** Decisions in a row, each with its regret. */
export interface Judged {
  /** Ticks since the session began. */
  from: number;
  /** The session's present tick. */
  now: number;
  /** None for ticks at which a result stood. */
  items: JudgedDecision[];
  more: boolean;
}

/** A decision against the best that could have been done at its moment. */
export interface JudgedDecision {
  /** Ticks since the session began. */
  tick: number;
  move: Move;
  /** How many of the six moves would have ended badly or off the road. */
  blocked: number;
  /** Ticks lost; null where the goal is, or was, out of reach. */
  ticks: number | null;
  /** Cost lost, by the configuration's charges; null as for `ticks`. */
  cost: number | null;
  /** Whether the goal could be reached before the move, and not after it. */
  lost: boolean;
  /** From the vehicle to what is nearest on the road, centre to centre; null where nothing else is there. */
  clearance_m?: number | null;
}

/** What a thing on the road is. */
export type Kind = "pothole" | "barrier" | "vehicle" | "pedestrian" | "av";

/** The thing that a place is described from: the nearest of a kind, or one by its id. */
export interface Landmark {
  kind?: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av" | null;
  nearest?: true | null;
  id?: string | null;
}

/** What can be said, or how a sentence that was begun could go on. */
export interface LanguageGuide {
  language: string;
  languages: string[];
  prefix: string | null;
  /** Empty when a prefix was given. */
  intents: IntentGuide[];
  /** Empty when a prefix was given. */
  taught: TaughtPhrase[];
  /** Whole sentences that begin with the prefix. */
  completions: string[];
  /** With a prefix and a session; none for an empty prefix. */
  preview: Preview | null;
}

/** How long after their deadline the latest ticks began. */
export interface Lateness {
  ticks: number;
  p50_ms: number;
  p99_ms: number;
  max_ms: number;
}

/** A session at a tick as a piece of a URL. */
export interface Link {
  /** `#/r/...` carries the session, `#/s/...` names it. */
  link: string;
  /** Ticks since the session began. */
  tick: number;
  /** Whether the link holds the whole session, so that no service need keep it. */
  carries: boolean;
}

/** Go on from what was saved under a name. */
export interface Load {
  do: "load";
  name: string;
}

/** One line of the log. */
export interface LogEvent {
  number: number;
  /** Ticks since the session began. */
  tick: number;
  type: string;
  text: string;
  ids: string[];
  cell: [number, number] | null;
}

/** An answer that takes long, as it stands. */
export interface LongAnswer {
  id: string;
  /** The id of the session that it is about. */
  session: string;
  /** What was asked for, such as `film`. */
  what: string;
  /** `failed`: what came of it is a problem, at `links.result`. */
  state: "running" | "done" | "failed";
  /** The share of the work that is done. */
  progress: number;
  /** `self`: this, again; DELETE cancels it. `result`: the answer, once it is done. */
  links: { [key: string]: string };
}

/** Totals over the episodes of a session. */
export interface Metrics {
  /** Episodes that have ended. */
  episodes: number;
  successes: number;
  crashes: number;
  stuck: number;
  success_rate: number | null;
  steps: number;
  moves: MoveCounts;
  distance_m: number;
  last_episode_ticks: number | null;
}

/** Who drives the first autonomous vehicle. */
export type Mode = "auto" | "manual";

/** A world, with the decision that led to it. */
export interface Moment {
  state: State;
  decision: Decision | null;
}

/** Named moments of all sessions, those named last first. */
export interface MomentPage {
  items: SessionMoment[];
  /** Send as `after` for what follows. */
  after: string | null;
  more: boolean;
}

/** Several ticks in a row. */
export interface Moments {
  items: Moment[];
  /** The session's present tick. */
  now: number;
}

/** What an autonomous vehicle may do in one tick. */
export type Move = "forward" | "left" | "right" | "forward_left" | "forward_right" | "stay";

/** How often each sort of move was made. */
export interface MoveCounts {
  forward: number;
  lateral: number;
  diagonal: number;
  stay: number;
}

/** Put things that are on the road somewhere else on it; they stay what they are. */
export interface MoveThings {
  do: "move";
  kind: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av";
  count: number | "all";
  where?: Where | null;
  to?: Where | null;
  by?: Shift | null;
}

/** An obstacle vehicle or a pedestrian. */
export interface Mover {
  id: string;
  kind: "vehicle" | "pedestrian";
  /** [column, row], row 0 at the goal */
  cell: [number, number];
  heading: "left" | "right";
  /** Whether a pothole holds it. */
  disabled: boolean;
}

/** Many episodes to run, in words or in figures. */
export interface NewEvaluation {
  /** As a sentence, such as `run 500 episodes with A*`. Beside it: session, seed, language. */
  text?: string | null;
  /** Search for worlds that one planner fails although they can be driven; numbers of things and layouts are drawn. Default: run episodes. */
  find?: "worst" | null;
  /** Episodes of each planner, up to 1,000,000; default 100. Of a search: worlds, up to 100,000; default 1,000. */
  runs?: number | null;
  /** Compared on the same roads, each with the first. Default: the road's. */
  planners?: string[] | null;
  /** A sentence that describes the roads. */
  scenario?: string | null;
  /** What the roads are drawn from. */
  config?: {
    columns?: number;
    visible_rows?: number;
    rows?: number;
    cell_m?: number;
    step_seconds?: number;
    spawn_probability?: number;
    pothole_probability?: number;
    potholes?: number | null;
    vehicles?: number | null;
    barriers?: number;
    pedestrians?: number;
    courtesy?: number;
    attentive?: number;
    collision?: "swept" | "cell";
    repetition?: boolean;
    reset_delay_s?: number;
    road?: "highway" | "city" | "rural" | null;
    layout?: "walls" | "narrows" | "dead_ends" | "crossing" | "maze" | null;
    traffic?: "none" | "light" | "normal" | "heavy" | null;
    planner?: string;
    preferences?: ("avoid_potholes" | "smooth_ride" | "fastest" | "cautious")[];
    safety_buffer?: number;
    sensor?: "perfect" | "camera" | "lidar" | "radar" | "fusion";
    weather?: "clear" | "rain" | "fog" | "snow";
    time_of_day?: "day" | "dusk" | "night" | "dawn";
    detection_sensitivity?: number;
    sensor_range_m?: number;
    sensor_noise?: number;
    false_positive_rate?: number;
    sensor_latency?: number;
    slip_probability?: number;
    traffic_by_hour?: number;
    dynamics?: "grid";
    behaviour?: "sideways";
    rules?: number;
    solvable?: boolean;
    seed?: number;
  } | null;
  /** Values that are compared, such as `weather` of `clear` and `fog`: each combination is run from the same seeds, and all are compared with the first. */
  vary?: Varied | null;
  /** A success map over two of these numbers of things, with `runs` episodes in each cell. `vary` may give their values, 2 to 12 each. */
  map?: ["potholes" | "vehicles" | "barriers" | "pedestrians", "potholes" | "vehicles" | "barriers" | "pedestrians"] | null;
  /** A scenario file, as JSON (see `roadtalk scenario schema`). Beside it: runs, planners, seed, language. */
  file?: { [key: string]: unknown } | null;
  /** A scenario that comes with Roadtalk, such as `rush-hour`, or with `session` a moment that was saved there. Beside it: runs, planners, vary, map, seed, language. */
  scenario_name?: string | null;
  /** Roads as in this session; alone or with a text, runs, planners. */
  session?: string | null;
  /** The session's own road from this moment on, in place of roads that are drawn. */
  road?: "this" | null;
  /** Of the first episode. Default: the session's, else 0. */
  seed?: number | null;
  /** Of the text and the report. In which language; `GET /language` names them. Default: the session's. */
  language?: "en" | "de" | null;
}

/** How another session goes on from a tick of this one. */
export interface NewFork {
  /** Default: now. */
  at_tick?: number | null;
  /** Done there first, together or the fork is not made. */
  actions?: Action[] | null;
  name?: string | null;
  /** Default: as this session is. */
  paused?: boolean | null;
}

/** What a session is called from now on. */
export interface NewName {
  /** Null takes the name away. */
  name: string | null;
}

/** How a session begins. Everything may be left out; without a seed one is drawn and told. */
export interface NewSession {
  name?: string | null;
  /** A sentence that describes a road. */
  scenario?: string | null;
  config?: {
    columns?: number;
    visible_rows?: number;
    rows?: number;
    cell_m?: number;
    step_seconds?: number;
    spawn_probability?: number;
    pothole_probability?: number;
    potholes?: number | null;
    vehicles?: number | null;
    barriers?: number;
    pedestrians?: number;
    courtesy?: number;
    attentive?: number;
    collision?: "swept" | "cell";
    repetition?: boolean;
    reset_delay_s?: number;
    road?: "highway" | "city" | "rural" | null;
    layout?: "walls" | "narrows" | "dead_ends" | "crossing" | "maze" | null;
    traffic?: "none" | "light" | "normal" | "heavy" | null;
    planner?: string;
    preferences?: ("avoid_potholes" | "smooth_ride" | "fastest" | "cautious")[];
    safety_buffer?: number;
    sensor?: "perfect" | "camera" | "lidar" | "radar" | "fusion";
    weather?: "clear" | "rain" | "fog" | "snow";
    time_of_day?: "day" | "dusk" | "night" | "dawn";
    detection_sensitivity?: number;
    sensor_range_m?: number;
    sensor_noise?: number;
    false_positive_rate?: number;
    sensor_latency?: number;
    slip_probability?: number;
    traffic_by_hour?: number;
    dynamics?: "grid";
    behaviour?: "sideways";
    rules?: number;
    solvable?: boolean;
    seed?: number;
  } | null;
  seed?: number | null;
  planner?: string | null;
  /** Default: running, or paused when replayed from a recording. */
  paused?: boolean | null;
  /** Replay this; alone but for name and paused. */
  recording?: Recording | null;
  /** Of its log, narration and replies, and of `scenario`; `GET /language` names them. Default: a recording's own, else en. A link that names a session keeps that session's. */
  language?: "en" | "de" | null;
  /** Open this; alone but for name and paused. See `link`. */
  link?: string | null;
}

/** An empty object. */
export type NoFields = { [key: string]: unknown };

/** One thing of a kind: the nearest one at a place. */
export interface OneThing {
  kind: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av";
  where?: Where | null;
}

/** One move as the planner saw it. */
export interface Option {
  move: Move;
  cell: [number, number] | null;
  verdict: "free" | "blocked" | "off_road";
  cost: number | null;
  reason: string;
  causes: string[];
  /** What spoke for or against it, in a few words. */
  text?: string;
}

/** What is otherwise, and from when: a move, actions or two planners, one of the three. */
export interface Otherwise {
  /** Default: now; of a move, the latest decision. */
  at_tick?: number | null;
  /** Driven whatever it meets; then the planner goes on. */
  move?: "forward" | "left" | "right" | "forward_left" | "forward_right" | "stay" | null;
  /** Done there, together or not at all. */
  actions?: Action[] | null;
  /** Two planners on this road; by default from where its episode began. */
  planners?: [string, string] | null;
  /** How many ticks of each are told at most. */
  ticks?: number;
}

/** How an episode stands. */
export type Outcome = "running" | "success" | "crash" | "stuck";

/** Where a fork was taken; the session it was taken from may be deleted since. */
export interface Parent {
  id: string;
  /** Ticks since the session began. */
  tick: number;
}

/** What a sentence means. */
export interface Parsed {
  text: string;
  actions: Action[];
  source: "grammar" | "matched" | "llm";
  corrections: Correction[];
}

/** The first tick at which the two decide differently. */
export interface Parting {
  /** Ticks since the session began. */
  tick: number;
  real: PartingMove;
  changed: PartingMove;
}

/** What one of the two does where they part. */
export interface PartingMove {
  move: Move;
  /** The move and its reason in a sentence. */
  text: string;
}

/** Stop the clock. */
export interface Pause {
  do: "pause";
}

/** A question of the service that the next sentence may answer. */
export interface PendingQuestion {
  /** What was said. */
  text: string;
  question: string;
  /** To answer, say the number of one or some of its words; "never mind" drops the question. */
  choices: ChoiceModel[];
}

/** A word of a taught phrase in whose place a number is said. */
export interface PhraseParameter {
  name: string;
  figures: string[];
}

/** Asks for a `pong`. */
export interface Ping {
  type: "ping";
}

/** What one tick changed: what moved, or the whole state where a road begins. */
export interface PlayedTick {
  /** Ticks since the session began. */
  tick: number;
  episode: number;
  status: Outcome;
  /** Cells of the egos, by id. */
  vehicles?: { [key: string]: [number, number] } | null;
  /** Cells of the movers that changed theirs, by id. */
  moved?: { [key: string]: [number, number] } | null;
  /** Headings of the movers that changed theirs, by id. */
  turned?: { [key: string]: "left" | "right" } | null;
  state?: State | null;
  decision: BriefDecision | null;
  cause: CrashCause | null;
}

/** The answer to `ping`. */
export interface PongMessage {
  type: "pong";
}

/** How the ego should weigh one way of driving against another. */
export interface Prefer {
  do: "prefer";
  preference: "avoid_potholes" | "smooth_ride" | "fastest" | "cautious" | "balanced";
}

/** What a sentence would do if it were sent as it stands. */
export interface Preview {
  standing: "does" | "asks" | "ambiguous" | "not_understood" | "refused";
  actions: Action[];
  /** Empty also where finding out would take long. */
  changes: Change[];
  /** What it would be refused or asked about with. */
  detail: string | null;
  unparsed: string[];
}

/** An error, as in RFC 9457. */
export interface ProblemDocument {
  type: string;
  title: string;
  status: number;
  detail: string;
  errors: FieldProblemModel[];
  /** Why a sentence was refused. */
  reason?: "not_understood" | "negation" | "empty" | "impossible" | null;
  /** What asks back: the grammar, or a language model. */
  source?: "grammar" | "matched" | "llm" | null;
  unparsed?: string[] | null;
  understood?: string[] | null;
  suggestions?: string[] | null;
  choices?: ChoiceModel[] | null;
  /** The question, where the session waits for the answer. */
  pending?: PendingQuestion | null;
  /** The session's sequence number, if it was changed meanwhile. */
  sequence?: number | null;
  /** How an evaluation stands that has no report. */
  state?: "queued" | "running" | "done" | "failed" | "cancelled" | null;
}

/** Why a `command` or `actions` was refused, under the id that was sent with it. */
export interface ProblemMessage {
  type: "problem";
  id: string;
  problem: ProblemDocument;
}

/** A question, and nothing but one. */
export interface Question {
  question: string;
  /** In which language; `GET /language` names them. Default: the session's. */
  language?: "en" | "de" | null;
  /** The past tick that is looked at: a question that names no tick of its own is asked of it, and the answer says which moment it is about. Orders are done now all the same. Default: now. */
  at_tick?: number | null;
}

/** The store answers. */
export interface Ready {
  status: "ready";
}

/** Start or stop recording. */
export interface Record {
  do: "record";
  on: boolean;
}

/** One accepted change of a recording. */
export interface RecordedEntry {
  sequence: number;
  /** Ticks since the session began. */
  tick: number;
  text: string | null;
  actions: Action[];
  /** What the world after it must be; not said by older recordings. */
  digest?: string | null;
}

/** A session as one small file. */
export interface Recording {
  format: "roadtalk-recording";
  version: 1;
  /** Of which version; recordings from before there were several name none. */
  rules?: number | null;
  name?: string | null;
  /** Any part of a road's configuration; what is left out is at its default. */
  config: {
    columns?: number;
    visible_rows?: number;
    rows?: number;
    cell_m?: number;
    step_seconds?: number;
    spawn_probability?: number;
    pothole_probability?: number;
    potholes?: number | null;
    vehicles?: number | null;
    barriers?: number;
    pedestrians?: number;
    courtesy?: number;
    attentive?: number;
    collision?: "swept" | "cell";
    repetition?: boolean;
    reset_delay_s?: number;
    road?: "highway" | "city" | "rural" | null;
    layout?: "walls" | "narrows" | "dead_ends" | "crossing" | "maze" | null;
    traffic?: "none" | "light" | "normal" | "heavy" | null;
    planner?: string;
    preferences?: ("avoid_potholes" | "smooth_ride" | "fastest" | "cautious")[];
    safety_buffer?: number;
    sensor?: "perfect" | "camera" | "lidar" | "radar" | "fusion";
    weather?: "clear" | "rain" | "fog" | "snow";
    time_of_day?: "day" | "dusk" | "night" | "dawn";
    detection_sensitivity?: number;
    sensor_range_m?: number;
    sensor_noise?: number;
    false_positive_rate?: number;
    sensor_latency?: number;
    slip_probability?: number;
    traffic_by_hour?: number;
    dynamics?: "grid";
    behaviour?: "sideways";
    rules?: number;
    solvable?: boolean;
    seed?: number;
  };
  entries: RecordedEntry[];
  /** Where it ends. */
  tick: number;
  /** Of its log; en where none is named. */
  language?: "en" | "de" | null;
  /** What the world at its end must be. */
  digest: string;
  /** Of the service that made it, which takes it although it is longer than others may be. */
  seal?: string | null;
}

/** Say again what was undone last (`steps` changes, by default one). */
export interface Redo {
  do: "redo";
  steps?: number | "all" | null;
}

/** Take `count` things of a kind (or `"all"`, or `"half"` of them) off the road. */
export interface Remove {
  do: "remove";
  kind: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av" | "everything";
  count: number | "all" | "half";
  where?: Where | null;
  except?: Where | null;
}

/** Put things of another kind (`by`) in the places of things. */
export interface Replace {
  do: "replace";
  kind: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av";
  count: number | "all";
  where?: Where | null;
  by: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av";
}

/** The present episode from its start, on the road it started with. */
export interface Reset {
  do: "reset";
}

/** What came of a `command` or `actions`, under the id that was sent with it. */
export interface ResultMessage {
  type: "result";
  id: string;
  result: CommandResult;
  /** True where it was given before, under the same key. */
  replayed?: boolean | null;
}

/** Start the clock. */
export interface Resume {
  do: "resume";
}

/** Go back some ticks, or to a tick, the latest crash, the start of the episode or of the session. */
export interface Rewind {
  do: "rewind";
  ticks?: number | null;
  to?: number | "crash" | "episode" | "start" | null;
}

/** Where to go back to. */
export interface RewindTo {
  /** Ticks since the session began. */
  tick: number;
}

/** Something said or done that changed the road, and still stands. */
export interface RoadChange {
  /** Ticks since the session began. */
  tick: number;
  sequence: number;
  /** As it was said; of typed actions, the sentence that says the same. */
  text: string;
  /** Whether it was said, rather than done by typed actions. */
  said: boolean;
}

/** The newest changes that stand, oldest first. */
export interface RoadChanges {
  items: RoadChange[];
  /** Whether older ones are left out. */
  more: boolean;
}

/** A rule that stands: "every 10 ticks add a car". */
export interface Rule {
  /** By which it is cancelled; never used again in the session. */
  number: number;
  /** The rule in the language of the session. */
  text: string;
  /** Ticks since the session began. */
  since: number;
  /** How often it has been done. */
  fired: number;
  /** The action that made it. */
  action: { [key: string]: unknown };
}

/** Something said to a session. */
export interface Said {
  /** At most 500 characters, unless the service is set otherwise. */
  text: string;
  /** Say what would be done, and do nothing. */
  dry_run?: boolean;
  /** In which language; `GET /language` names them. Default: the session's. */
  language?: "en" | "de" | null;
  /** The past tick that is looked at: a question that names no tick of its own is asked of it, and the answer says which moment it is about. Orders are done now all the same. Default: now. */
  at_tick?: number | null;
}

/** Keep the session under a name. */
export interface Save {
  do: "save";
  name: string;
}

/** A moment of a session that was given a name. */
export interface SavedMoment {
  name: string;
  /** The change that named it. */
  sequence: number;
  /** Ticks since the session began. */
  tick: number;
}

/** The named moments of a session, by name. */
export interface SavedMoments {
  items: SavedMoment[];
}

/** A sentence and what it means. */
export interface Saying {
  text: string;
  actions: Action[];
}

/** A fresh world; what is not named is at its default. */
export interface Scenario {
  do: "scenario";
  weather?: "clear" | "rain" | "fog" | "snow" | null;
  time_of_day?: "day" | "dusk" | "night" | "dawn" | null;
  road?: "highway" | "city" | "rural" | null;
  layout?: "walls" | "narrows" | "dead_ends" | "crossing" | "maze" | null;
  traffic?: "none" | "light" | "normal" | "heavy" | null;
  potholes?: number | null;
  vehicles?: number | null;
  barriers?: number | null;
  pedestrians?: number | null;
  avs?: number | null;
  planner?: "rules" | "priority" | "astar" | "dijkstra" | "bfs" | "exact" | "dwa" | "rl" | "cooperative" | null;
  sensor?: "perfect" | "camera" | "lidar" | "radar" | "fusion" | null;
}

/** The keys of `scenario`, as conditions of an evaluation. */
export interface ScenarioParts {
  weather?: "clear" | "rain" | "fog" | "snow" | null;
  time_of_day?: "day" | "dusk" | "night" | "dawn" | null;
  road?: "highway" | "city" | "rural" | null;
  layout?: "walls" | "narrows" | "dead_ends" | "crossing" | "maze" | null;
  traffic?: "none" | "light" | "normal" | "heavy" | null;
  potholes?: number | null;
  vehicles?: number | null;
  barriers?: number | null;
  pedestrians?: number | null;
  avs?: number | null;
  planner?: "rules" | "priority" | "astar" | "dijkstra" | "bfs" | "exact" | "dwa" | "rl" | "cooperative" | null;
  sensor?: "perfect" | "camera" | "lidar" | "radar" | "fusion" | null;
}

/** What the first ego sees at a tick, and what it misses. */
export interface Sensed {
  /** Ticks since the session began. */
  tick: number;
  sensor: string;
  weather: "clear" | "rain" | "fog" | "snow";
  time_of_day: "day" | "dusk" | "night" | "dawn";
  seen: SensedThing[];
  /** Ids of things that are there and not seen where they are. */
  missed: string[];
}

/** A thing as it is seen. */
export interface SensedThing {
  id: string;
  kind: Kind;
  /** [column, row], row 0 at the goal */
  cell: [number, number];
  /** How sure the sensor is that it is there, 0 to 1. */
  likelihood: number;
  /** The devices that report it in this tick; none where it is remembered, or with another sensor. */
  sensors: string[];
  /** Whether it is there. */
  real: boolean;
}

/** A session as it stands. */
export interface Session {
  id: string;
  name: string | null;
  created_at: string;
  paused: boolean;
  /** How fast the clock plays the session; `max`: as fast as possible. Affects no world. */
  playback_speed: number | "max";
  mode: Mode;
  /** Ticks since the session began. */
  tick: number;
  episode: number;
  status: Outcome;
  /** Changes the session has accepted. */
  sequence: number;
  seed: number;
  config: { [key: string]: unknown };
  /** The code of the language that its log and narration are in. */
  language?: string;
  /** The version of the rules that it runs under. */
  rules: number;
  /** What to tell whoever opens it, where these are not the rules of today. */
  rules_note: string | null;
  /** What to say for a road like this one; null where no sentence describes it. */
  sentence: string | null;
  /** The question that the session asked last, while nobody has answered it. */
  pending?: PendingQuestion | null;
  /** Of a fork, or a session that a link opened; else null. */
  parent: Parent | null;
  /** Open streams of it, sockets and events alike. */
  watchers?: number;
  links: { [key: string]: string };
}

/** A named moment, and the session it is in. */
export interface SessionMoment {
  name: string;
  sequence: number;
  /** Ticks since the session began. */
  tick: number;
  session: string;
  session_name: string | null;
  links: { [key: string]: string };
}

/** Sessions, newest first. */
export interface SessionPage {
  items: SessionSummary[];
  /** Send as `after` for what follows. */
  after: string | null;
  more: boolean;
}

/** A session in a list. One that is not live is restored when it is asked for. */
export interface SessionSummary {
  id: string;
  name: string | null;
  created_at: string;
  seed: number;
  live: boolean;
  /** The session's tick, or where it was last stored. */
  tick: number;
  /** Of a fork, or a session that a link opened; else null. */
  parent: Parent | null;
  links: { [key: string]: string };
}

/** Give a parameter a value. */
export interface Set {
  do: "set";
  parameter: "weather" | "time_of_day" | "traffic" | "planner" | "sensor" | "dynamics" | "playback_speed" | "target_speed_kmh" | "step_seconds" | "spawn_probability" | "pothole_probability" | "courtesy" | "attentive" | "sensor_noise" | "detection_sensitivity" | "false_positive_rate" | "sensor_latency" | "slip_probability" | "traffic_by_hour" | "sensor_range_m" | "safety_buffer" | "columns" | "rows" | "seed";
  value: number | string;
}

/** Add or remove until there are exactly `count` things of a kind. */
export interface SetCount {
  do: "set_count";
  kind: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av";
  count: number;
}

/** Who drives: a person or the planner. */
export interface SetMode {
  do: "mode";
  mode: Mode;
  ego?: string | null;
}

/** One of several processes that hold sessions. */
export interface ShardHealth {
  shard: number;
  /** `down`: it is being replaced; its sessions come back with it. */
  state: "up" | "down";
  /** Where it listens for the service's entry; None while it is down. */
  address: string | null;
  process: number | null;
  restarts: number;
  sessions: number;
  watchers: number;
}

/** So many cells to one side. */
export interface Shift {
  side: "ahead" | "behind" | "left" | "right";
  cells?: number;
}

/** Show a view. */
export interface Show {
  do: "show";
  view: "road" | "schematic" | "occupancy" | "plan" | "log" | "potholes" | "sensors" | "path" | "metrics";
}

/** One of the two runs. */
export interface Side {
  /** Where it begins. */
  state: State;
  ticks: PlayedTick[];
  end: End;
}

/** An evaluation that a sentence or an action has started. */
export interface StartedEvaluation {
  id: string;
  links: { [key: string]: string };
}

/** The world at a tick. */
export interface State {
  session: string;
  /** Ticks since the session began. */
  tick: number;
  /** Simulated seconds since the session began. */
  time_s: number;
  episode: number;
  episode_tick: number;
  status: Outcome;
  cause: CrashCause | null;
  columns: number;
  rows: number;
  visible_rows: number;
  step_seconds: number;
  paused: boolean;
  /** How fast the clock plays the session; `max`: as fast as possible. Affects no world. */
  playback_speed: number | "max";
  mode: Mode;
  planner: string;
  /** What the egos see with. */
  sensor: string;
  weather: "clear" | "rain" | "fog" | "snow";
  time_of_day: "day" | "dusk" | "night" | "dawn";
  /** The egos, in order of their ids. */
  vehicles: Vehicle[];
  movers: Mover[];
  hazards: Hazard[];
  metrics: Metrics;
  /** Equal exactly when two worlds are equal. */
  digest: string;
  /** Changes the session has accepted. */
  sequence: number;
  /** How many changes can be undone, one after the other. */
  undo: number;
  /** How many undone changes can be made again. */
  redo: number;
  /** The rules that stand, in the order of their numbers. */
  rules?: Rule[];
}

/** A full state for a reader that was too slow. */
export interface StateMessage {
  type: "state";
  /** The ticks it was not sent, first and last. */
  missed: [number, number] | null;
  state: State;
  /** Id of the message, to resume after it. */
  event: string;
}

/** Run some ticks at once, and stay paused after them. */
export interface Step {
  do: "step";
  ticks: number;
}

/** Ticks that were run. */
export interface StepResult {
  ticks: number;
  decisions: Decision[];
  state: State;
}

/** How many ticks to run. */
export interface StepTicks {
  ticks?: number;
}

/** The service stops: come back later. The last of the server-sent events; a socket is closed instead. */
export interface StoppingMessage {
  type: "stopping";
  code: 1012;
}

export type StreamMessage = HelloMessage | TickMessage | ChangedMessage | StateMessage | GoneMessage | StoppingMessage | ResultMessage | ProblemMessage | ErrorMessage | PongMessage | SubscribedMessage | UnsubscribedMessage;

export type StreamRequest = Command | Actions | Ping | Subscribe | Unsubscribe;

/** A named set of preferences and settings (`prompts/styles.yaml`). */
export interface Style {
  do: "style";
  style: string;
}

/** Asks for pictures as well; a second one takes the place of the first. */
export interface Subscribe {
  type: "subscribe";
  frames: "jpeg" | "webp";
  view?: "road" | "schematic";
  fps?: number;
  side?: number;
  theme?: "dark" | "light";
  /** Bounding boxes around what moves. */
  boxes?: boolean;
  /** The strip of figures along the upper edge, and the result across the middle. */
  figures?: boolean;
  /** The way behind the vehicle, its move and the next one. */
  path?: boolean;
  /** Where movers are expected in the next ticks. */
  forecast?: boolean;
}

/** The pictures that follow as binary messages. */
export interface SubscribedMessage {
  type: "subscribed";
  frames: "jpeg" | "webp";
  view: "road" | "schematic";
  fps: number;
  /** Pixels of the longer side. */
  side: number;
  theme?: "dark" | "light";
  /** Bounding boxes around what moves. */
  boxes?: boolean;
  /** The strip of figures along the upper edge, and the result across the middle. */
  figures?: boolean;
  /** The way behind the vehicle, its move and the next one. */
  path?: boolean;
  /** Where movers are expected in the next ticks. */
  forecast?: boolean;
}

/** Let two things change places. */
export interface Swap {
  do: "swap";
  first: OneThing;
  second: OneThing;
}

/** A phrase that was taught, and what it means. */
export interface TaughtPhrase {
  phrase: string;
  meaning: Action[];
  /** The sentence that says the same. */
  sentence: string;
  /** The words of the phrase in whose place a number is said. */
  parameters?: string[];
}

/** From now on, a phrase means these actions. */
export interface Teach {
  do: "teach";
  phrase: string;
  meaning: Action[];
  parameters?: PhraseParameter[] | null;
}

/** A sentence to be understood. */
export interface Text {
  text: string;
  /** In which language; `GET /language` names them. */
  language?: "en" | "de";
}

/** One tick: what moved, or the whole state where a new road begins. */
export interface TickMessage {
  type: "tick";
  /** Ticks since the session began. */
  tick: number;
  sequence: number;
  episode: number;
  status: Outcome;
  /** Cells of the egos, by id; absent where `state` is there. */
  vehicles?: { [key: string]: [number, number] } | null;
  /** Cells of the movers that changed theirs, by id; absent where `state` is there. */
  moved?: { [key: string]: [number, number] } | null;
  /** Headings of the movers that changed theirs, by id; absent where `state` is there. */
  turned?: { [key: string]: "left" | "right" } | null;
  /** The whole state where a new road begins; absent otherwise. */
  state?: State | null;
  decision: BriefDecision | null;
  narration: string | null;
  events: LogEvent[];
  metrics: Metrics;
  digest: string;
  /** Id of the message, to resume after it. */
  event: string;
}

/** Lets one socket in: its first message is `{"type": "auth", "ticket": ...}`. */
export interface Ticket {
  /** To be sent as the first message of a socket. */
  ticket: string;
  /** Seconds within which it must be used. */
  good_for_s: number;
}

/** A tick that matters. */
export interface TimelineMark {
  /** Ticks since the session began. */
  tick: number;
  /** `near_miss`: a mover came into the cell that the ego had just left, and would have hit it had it stayed. `episode`: one begins. */
  kind: "crash" | "success" | "stuck" | "near_miss" | "episode";
  ids: string[];
  cell: [number, number] | null;
}

/** A stretch of a run. */
export interface TimelinePage {
  /** Ticks since the session began. */
  from: number;
  /** The session's present tick. */
  now: number;
  /** A letter for each tick from `from` on: F forward, L left, R right, l forward left, r forward right, s stay, - where the result of an episode stood. */
  moves: string;
  marks: TimelineMark[];
  more: boolean;
}

/** A rule: whenever the condition comes to hold, these actions are done at the end of that tick. The condition of a storyboard event in ASAM OpenSCENARIO, on its rising edge. */
export interface Trigger {
  do: "trigger";
  when: Condition;
  then: (Add | Remove | SetCount | MoveThings | Swap | Replace | Copy | Scenario | Reset | SetMode | Drive | Set | Adjust | Prefer | Pause)[];
  until?: Condition | null;
  times?: number | null;
}

/** Actions of the language contract, no language involved; done together or not at all. */
export interface TypedActions {
  actions: Action[];
  /** Say what would be done, and do nothing. */
  dry_run?: boolean;
  /** The past tick that is looked at: a question that names no tick of its own is asked of it, and the answer says which moment it is about. Orders are done now all the same. Default: now. */
  at_tick?: number | null;
}

/** Take back the latest changes (`steps`, by default one), as if they had never been said. */
export interface Undo {
  do: "undo";
  steps?: number | "all" | null;
}

/** Asks for no more pictures. */
export interface Unsubscribe {
  type: "unsubscribe";
}

/** No more pictures follow. */
export interface UnsubscribedMessage {
  type: "unsubscribed";
}

/** Values that are compared: an evaluation runs under each combination of them, from the same seeds. */
export interface Varied {
  weather?: ("clear" | "rain" | "fog" | "snow")[] | null;
  time_of_day?: ("day" | "dusk" | "night" | "dawn")[] | null;
  sensor?: ("perfect" | "camera" | "lidar" | "radar" | "fusion")[] | null;
  traffic?: ("none" | "light" | "normal" | "heavy")[] | null;
  potholes?: number[] | null;
  vehicles?: number[] | null;
  barriers?: number[] | null;
  pedestrians?: number[] | null;
}

/** An ego: a vehicle that a planner or a person drives. Other vehicles are movers. */
export interface Vehicle {
  id: string;
  kind: "av";
  /** [column, row], row 0 at the goal */
  cell: [number, number];
}

/** A place, by any of its parts; parts combine ("15 m ahead in the left lane"). */
export interface Where {
  lane?: "left" | "middle" | "right" | number | null;
  lanes?: [number, number] | null;
  row?: number | null;
  rows?: [number, number] | null;
  cell?: [number, number] | null;
  side?: "ahead" | "behind" | "left" | "right" | "beside" | null;
  distance_m?: number | null;
  cells?: number | null;
  nearest?: true | null;
  id?: string | null;
  each?: "lane" | null;
  of?: Landmark | null;
}

/** A road user that is asked about: the nearest one of a kind at a place, or one by its id. */
export interface Which {
  lane?: "left" | "middle" | "right" | number | null;
  lanes?: [number, number] | null;
  row?: number | null;
  rows?: [number, number] | null;
  cell?: [number, number] | null;
  side?: "ahead" | "behind" | "left" | "right" | "beside" | null;
  distance_m?: number | null;
  cells?: number | null;
  nearest?: true | null;
  id?: string | null;
  each?: "lane" | null;
  of?: Landmark | null;
  kind?: "pothole" | "vehicle" | "barrier" | "pedestrian" | "av" | null;
}

/** One action of the language contract. */
export type Action = Add | Remove | SetCount | MoveThings | Swap | Replace | Copy | Scenario | Reset | SetMode | Drive | Set | Adjust | Prefer | Trigger | Cancel | Goal | Style | Pause | Resume | Undo | Redo | Step | Rewind | Show | Hide | Ask | Chat | Evaluate | EvaluationTalk | FindWorst | Advise | Save | Load | Record | Teach | Forget | Drop;

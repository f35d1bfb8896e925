// @ts-check
/**
 * The page's one store: a state, events that carry it on, and those who are told.
 *
 * What takes time (questions to the service, timers) reads the state and dispatches events when it knows more; it keeps
 * nothing of its own that others would want to see.
 */

/**
 * @template State, Event
 * @typedef {object} Store
 * @property {() => State} state  as it is now
 * @property {(event: Event) => void} dispatch
 * @property {(listener: (state: State, before: State) => void) => () => void} subscribe  called after each
 *   change, in order; returns the unsubscribe function
 */

/**
 * @template State, Event
 * @param {(state: State, event: Event) => State} reduce  pure
 * @param {State} initial
 * @returns {Store<State, Event>}
 */
export function createStore(reduce, initial) {
  let state = initial;
  /** @type {Set<(state: State, before: State) => void>} */
  const listeners = new Set();
  /** Changes not told yet: a listener may dispatch, and all hear of changes in the same order. @type {[State, State][]} */
  const untold = [];

  /** @param {Event} event */
  function dispatch(event) {
    const before = state;
    state = reduce(state, event);
    if (state === before) return;
    untold.push([state, before]);
    if (untold.length > 1) return;
    while (untold.length > 0) {
      const [now, then] = untold[0];
      for (const listener of listeners) listener(now, then);
      untold.shift();
    }
  }

  return {
    state: () => state,
    dispatch,
    subscribe(listener) {
      listeners.add(listener);
      return () => void listeners.delete(listener);
    },
  };
}

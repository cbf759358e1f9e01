// Working point of force laws: the deviations that the linearised laws themselves cause.
// See response/working_point.py.

/** @typedef {import("./network_rows.js").Networks} Networks */
/** @typedef {import("./network_rows.js").State} State */

export const MOST = 400; // iterations after which the working point counts as not reached
export const NEAR = 1e-8; // relative change of every deviation in the last iteration
const FIRST_RATE = 0.2, FIRST_DEFLECTION = 0.01; // m/s and m, deviations to begin with
const LARGEST = 2; // change of ln s in an iteration
const QUICK = 15; // iterations before steps become shorter

/**
 * Return the first state of every law.
 * @param {Networks} networks
 * @returns {State[]}
 */
export function firstStates({ laws }) {
  return laws.map(({ ofRate }) => ({
    deviation: ofRate ? FIRST_RATE : FIRST_DEFLECTION, mean: 0, force: 0, slope: 0, change: 0,
    before: 0, step: 0, next: 0,
  }));
}

/**
 * Return the damping (t,) of linear dampers in parallel with each network.
 * @param {Networks} networks
 * @param {ArrayLike<number>} values
 * @returns {number[]}
 */
export function dampingBeside({ gain, order, port, sag }, values) {
  return Array.from(port, (at) =>
    gain.reduce((sum, own, c) => sum + (order[c] === 1 ? own[at * sag.length + at] * values[c] : 0), 0),
  );
}

/**
 * Take the next deviations by those that result from the last; return the largest relative change.
 * @param {Networks} networks
 * @param {number[]} damping (t,)
 * @param {State[]} states
 * @param {number} iteration
 * @returns {number}
 */
export function improve(networks, damping, states, iteration) {
  let error = 0, product = 0, length = 0;
  for (const [i, state] of states.entries()) {
    let step = Math.log(state.next / state.deviation);
    error = Math.max(error, Math.abs(step));
    step /= 1 + 0.5 * elasticity(networks, damping, states, i);
    const difference = step - state.step;
    product += difference * step;
    length += difference * difference;
    state.next = step;
  }
  const back = iteration > 0 && iteration < QUICK && length > 0 ? product / length : 0;
  for (const state of states) {
    const x = Math.log(state.deviation), step = state.next;
    let change = step - back * (x - state.before + step - state.step);
    if (!(Math.abs(change) < LARGEST)) change = Math.max(-LARGEST, Math.min(step, LARGEST));
    [state.before, state.step] = [x, step];
    state.deviation = Math.exp(x + relaxation(iteration) * change);
  }
  return error;
}

/** @param {number} iteration @returns {number} the share of a step that is taken: less where stiff stops swing */
function relaxation(iteration) {
  if (iteration < 3 * QUICK) return iteration < QUICK ? 1 : 0.5;
  return iteration < 7 * QUICK ? 0.15 : 0.04;
}

/**
 * Return the elasticity of the total damping in parallel with a law of the rate, 0 for a law of the deflection.
 * @param {Networks} networks
 * @param {number[]} damping
 * @param {State[]} states
 * @param {number} which
 * @returns {number}
 */
function elasticity({ laws }, damping, states, which) {
  const { ofRate, network } = laws[which];
  if (!ofRate) return 0;
  let total = damping[network], rise = 0;
  laws.forEach((law, i) => {
    if (law.ofRate && law.network === network) {
      total += law.square * states[i].slope;
      rise += law.square * states[i].change;
    }
  });
  return total > 0 ? rise / total : 0;
}

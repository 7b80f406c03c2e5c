// SPDX-License-Identifier: MIT
// The actions of the page on a drive, by the names that the program's server has too. Each says what was done.
import * as captures from "./captures.js";
import * as session from "./session.js";
import * as settings from "./settings.js";

function requireNoJob(link) {
  if (link.job && link.job.running) {
    throw new Error(`${link.job.name} runs: wait`);
  }
}

export async function run(watcher, { speed_e_radps }, link) {
  requireNoJob(link);
  watcher.begin();
  await session.run(watcher, speed_e_radps);
  return `runs to ${watcher.speedWords(speed_e_radps)}`;
}

export async function move(watcher, { turns, relative, far, speed_e_radps }, link) {
  requireNoJob(link);
  const units = Math.round(turns * watcher.constants.TURN_UNITS);
  watcher.begin();
  await session.move(watcher, { units, relative, far, speed: speed_e_radps });
  return `moves ${relative ? "by" : "to"} ${turns} turns, and holds the shaft there`;
}

export async function reset(watcher, _args, link) {
  requireNoJob(link);
  await session.reset(watcher);
  return "the fault is reset";
}

export async function scope(watcher, setup) {
  await captures.arm(watcher.drive, setup);
  watcher.setup = setup;
  return "";
}

export async function write(watcher, { values }) {
  try {
    await settings.write(watcher, values);
  } finally {
    watcher.parametersWanted = true;
  }
  return `${Object.keys(values).length} written: they last until the drive restarts; save keeps them`;
}

/** A job: its progress is in the states. */
function restart(watcher, link, name, command) {
  requireNoJob(link);
  const job = { name, stage: "the drive restarts", share: 0.5, running: true, error: "", said: "", file_name: "" };
  link.job = job;
  settings
    .command(watcher, command)
    .then((said) => Object.assign(job, { said }), (error) => Object.assign(job, { error: error.message }))
    .finally(() => {
      job.running = false;
      watcher.parametersWanted = true;
    });
  return "";
}

export const save = (watcher, _args, link) => restart(watcher, link, "storing of the parameters", "STORE_PARAMETERS");
export const defaults = (watcher, _args, link) => restart(watcher, link, "return to the defaults", "RESTORE_PARAMETERS");

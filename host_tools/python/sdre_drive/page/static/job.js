// SPDX-License-Identifier: MIT
// Progress and end of something that takes a while.
import { el, say } from "./dom.js";

export class JobView {
  /** @param names of the jobs that it shows */
  constructor(names) {
    this.names = names;
    this.bar = el("progress", { max: 1, value: 0, "aria-label": names[0] });
    this.words = el("p", { role: "status" }, "");
    this.box = el("div", { hidden: true }, this.bar, this.words);
  }

  show(job) {
    const mine = job && this.names.includes(job.name);
    this.box.hidden = !mine;
    if (!mine) {
      return;
    }
    this.bar.hidden = !job.running;
    this.bar.value = job.share;
    this.words.classList.toggle("wrong", Boolean(job.error));
    say(this.words, job.running ? `${job.name}: ${job.stage}` : job.error || job.said);
  }
}

// SPDX-License-Identifier: MIT
// Another motor's constants, of `sdre-gains image`, into the drive's flash.
import { byId, el, field, say } from "./dom.js";
import { writer } from "./control.js";
import { JobView } from "./job.js";

const MOST_OCTETS = 200000;

export class Image {
  constructor(page) {
    this.page = page;
    this.file = el("input", { type: "file", id: "image-file" });
    this.force = el("p", { id: "in-force" }, "");
    this.job = new JobView(["loading of an image", "return to the compiled-in constants", "storing of the parameters", "return to the defaults"]);
    const forget = writer("Forget it: back to what is compiled in", { id: "image-forget" });
    forget.addEventListener("click", () => this.page.do("forget_image"));
    const form = el(
      "form",
      { noValidate: true, "aria-label": "Image" },
      this.force,
      field("file of sdre-gains image", this.file, "The motor has to be stopped. The drive restarts."),
      el("div", { className: "row" }, writer("Load", { type: "submit", id: "image-load", className: "main" }), forget),
    );
    form.addEventListener("submit", (e) => {
      e.preventDefault();
      this.page.tried(() => this.load());
    });
    byId("image").append(form, this.job.box);
  }

  know(facts) {
    say(this.force, `In force: ${facts.name}, ${facts.digest}, for ${facts.board}.`);
  }

  async load() {
    const file = this.file.files[0];
    if (!file) {
      throw new Error("Choose a file first.");
    }
    if (file.size > MOST_OCTETS) {
      throw new Error(`${file.name}: ${file.size} octets are no image of sdre-gains`);
    }
    const octets = new Uint8Array(await file.arrayBuffer());
    const text = Array.from(octets, (octet) => String.fromCharCode(octet)).join("");
    await this.page.do("image", { name: file.name, octets: btoa(text) });
  }

  show(state) {
    this.job.show(state && state.job);
  }
}

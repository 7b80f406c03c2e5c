// SPDX-License-Identifier: MIT
// Stands in for navigator.serial: one port, whose line is a WebSocket to the virtual drive. window.line tells what went over it.
window.line = { opened: null, sent: [], deaf: false };
class FakePort {
  async open(options) {
    window.line.opened = options;
    const socket = new WebSocket(`ws://${location.host}/line`);
    socket.binaryType = "arraybuffer";
    await new Promise((done) => (socket.onopen = done));
    this.readable = new ReadableStream({
      start: (controller) => {
        socket.onmessage = (event) => window.line.deaf || controller.enqueue(new Uint8Array(event.data));
        window.line.unplug = () => {
          this.readable = null;
          socket.onmessage = null;
          controller.error(new Error("the device has been lost"));
        };
      },
    });
    this.writable = new WritableStream({
      write: (octets) => {
        window.line.sent.push([performance.now(), ...octets]);
        socket.send(octets);
      },
    });
  }
}
Object.defineProperty(navigator, "serial", { value: { requestPort: async () => new FakePort() } });
window.addEventListener("keydown", () => (window.line.pressed = performance.now()), true);

// Time: a slider, and playing.
import type {Connection} from "../connection.js";
import {byId} from "../controls.js";

const pointer = "/volume/time_step", name = "time step";

export class TimeSteps {
  private readonly slider = byId("time", HTMLInputElement);
  private readonly play = byId("play", HTMLButtonElement);
  private times: number[] = [];
  private step = 0;
  private isPlaying = false;

  constructor(private readonly connection: Connection) {
    this.slider.oninput = () => this.tell(Number(this.slider.value));
    this.slider.onchange = () => connection.tell({type: "release"});
    this.play.onclick = () => (this.isPlaying ? this.stop() : this.start());
  }

  show(times: number[], step: number) {
    this.times = times;
    this.step = step;
    byId("time-section", HTMLElement).hidden = times.length < 2;
    this.slider.max = String(times.length - 1);
    this.slider.value = String(step);
    byId("time-text", HTMLOutputElement).textContent = String(times[step] ?? "");
  }

  private tell(step: number) {
    this.connection.tell({type: "set", pointer, value: step, name});
  }

  private start() {
    this.isPlaying = true;
    this.showPlaying();
    this.goOn();
  }

  stop() {
    if (this.isPlaying) {
      this.isPlaying = false;
      this.showPlaying();
      this.connection.tell({type: "release"});
    }
  }

  private showPlaying() {
    this.play.setAttribute("aria-pressed", String(this.isPlaying));
    this.play.textContent = this.isPlaying ? "Stop" : "Play";
  }

  /** The step is seen: the next one, if it plays. */
  goOn() {
    if (this.isPlaying && this.times.length > 0) {
      this.tell((this.step + 1) % this.times.length);
    }
  }
}

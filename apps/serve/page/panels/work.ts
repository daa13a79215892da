// What takes long: how far it is, and a button that stops it. One at a time.
import {byId} from "../controls.js";
import type {AskOrSay} from "../messages.js";

export class Work {
  private readonly shown = byId("work", HTMLElement);
  private readonly words = byId("work-text", HTMLElement);
  private readonly bar = byId("work-progress", HTMLProgressElement);
  /** What is being done. */
  private current: {name: string; isStopped: boolean} | null = null;

  private done = 0;
  private share = 1;

  constructor(private readonly ask: AskOrSay, private readonly say: (what: unknown) => void) {
    byId("work-stop", HTMLButtonElement).onclick = () => this.stop();
  }

  private stop() {
    if (this.current) {
      this.current.isStopped = true;
      this.ask({type: "stop"});
    }
  }

  /** Does it, unless something else is being done; says what goes wrong. `isStopped` is asked between its steps. */
  async run<T>(name: string, does: (isStopped: () => boolean) => Promise<T>): Promise<T | null> {
    if (this.current) {
      this.say(`busy ${this.current.name}: stop it, or wait`);
      return null;
    }
    const current = this.current = {name, isStopped: false};
    this.step(0, 1);
    this.bar.removeAttribute("value");
    this.words.textContent = name;
    this.shown.hidden = false;
    try {
      const result = await does(() => current.isStopped);
      return current.isStopped ? null : result;
    } catch (error) {
      if (!current.isStopped) {
        this.say(error);
      }
      return null;
    } finally {
      this.current = null;
      this.shown.hidden = true;
    }
  }

  /** So many of all steps are done. */
  step(nDone: number, n: number) {
    this.done = nDone / n;
    this.share = 1 / n;
    if (n > 1) {
      this.bar.value = this.done;
    }
  }

  /** Of the step, from 0 to 1; less if nobody knows. */
  progress(fraction: number) {
    if (fraction >= 0) {
      this.bar.value = this.done + this.share * fraction;
    }
  }
}

// The line to the server: messages as JSON, answers by number, frames as bytes, and coming back after a loss.
import type {Answer, Answered, Frame, Kind, Message, Messages, Told} from "./messages.js";

const retryMilliseconds = [300, 1000, 2000, 4000];

/** What the address names comes first. Frames in pages of others may have no storage. */
function sessionName(): string {
  try {
    return new URLSearchParams(location.search).get("session") ?? sessionStorage.getItem("elvis-session") ?? "";
  } catch {
    return "";
  }
}

function keepSession(name: string) {
  try {
    sessionStorage.setItem("elvis-session", name);
  } catch {
    // The session is lost when the frame is loaded anew.
  }
}

export type Listener = {message: (told: Exclude<Told, Frame>) => void; frame: (frame: Frame, bytes: Uint8Array) => void; line: (text: string) => void};
/** `done` gets what the answer holds, with the bytes behind it; its asker knows what that is. */
type Waiting = {done: (answer: unknown) => void; failed: (error: Error) => void};

export class Connection {
  private readonly token = new URLSearchParams(location.search).get("token") ?? "";
  private readonly waiting = new Map<number, Waiting>();
  private number = 0;
  private failures = 0;
  private ended = false;
  socket: WebSocket | null = null;

  constructor(private readonly listener: Listener) {}

  open() {
    // Relative to the page, so that it does not matter where a proxy has put it.
    const url = new URL("session", location.href.replace(/^http/, "ws"));
    url.search = new URLSearchParams({token: this.token, session: sessionName()}).toString();
    url.hash = "";
    const socket = new WebSocket(url);
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => this.receive(event.data);
    socket.onclose = () => this.closed(socket);
  }

  private receive(data: string | ArrayBuffer) {
    this.failures = 0;
    if (typeof data === "string") {
      this.dispatch(JSON.parse(data) as Told | Answered, null);
      return;
    }
    const length = new DataView(data).getUint32(0, true);
    const facts = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length))) as Frame | Answered;
    this.dispatch(facts, new Uint8Array(data, 4 + length));
  }

  private dispatch(told: Told | Answered, bytes: Uint8Array | null) {
    switch (told.type) {
    case "answer":
      this.takeWaiting(told.id)?.done({...told, bytes});
      return;
    case "error": {
      const asked = typeof told.id === "number" ? this.takeWaiting(told.id) : undefined;
      if (asked) {
        asked.failed(new Error(told.text));
        return;
      }
      break;
    }
    case "frame":
      this.listener.frame(told, bytes ?? new Uint8Array());
      return;
    case "hello":
      keepSession(told.session);
      this.listener.line("");
      break;
    case "taken":
      this.ended = true;
      this.socket?.close();
      break;
    }
    this.listener.message(told);
  }

  private takeWaiting(id: number): Waiting | undefined {
    const asked = this.waiting.get(id);
    this.waiting.delete(id);
    return asked;
  }

  private closed(socket: WebSocket) {
    if (socket !== this.socket) {
      return;
    }
    this.socket = null;
    for (const asked of this.waiting.values()) {
      asked.failed(new Error("the connection was lost"));
    }
    this.waiting.clear();
    if (this.ended) {
      this.listener.line("continued in another tab; reload to take it back");
      return;
    }
    // A server that was started anew has another address.
    this.listener.line(this.failures < retryMilliseconds.length ? "connection lost, trying again" : "no connection: was the server started anew?");
    const wait = retryMilliseconds[Math.min(this.failures++, retryMilliseconds.length - 1)];
    setTimeout(() => this.open(), wait);
  }

  /** Without an answer. */
  tell(message: Message) {
    this.send(message);
  }

  private send(message: {type: Kind; id?: number}) {
    if (this.socket?.readyState === WebSocket.OPEN) {
      this.socket.send(JSON.stringify(message));
    }
  }

  ask<K extends Kind>(message: {type: K} & Messages[K][0]): Promise<Answer<K>> {
    return new Promise((done, failed) => {
      if (this.socket?.readyState !== WebSocket.OPEN) {
        failed(new Error("there is no connection"));
        return;
      }
      const id = ++this.number;
      this.waiting.set(id, {done: (answer) => done(answer as Answer<K>), failed});
      this.send({...message, id});
    });
  }
}

// The line to the server: messages as JSON, answers by number, frames as bytes, and coming back after a loss.

/** @typedef {Record<string, any>} Message */

const retryMilliseconds = [300, 1000, 2000, 4000];

/** What the address names comes first. Frames in pages of others may have no storage. */
function sessionName() {
  try {
    return new URLSearchParams(location.search).get("session") ?? sessionStorage.getItem("elvis-session") ?? "";
  } catch {
    return "";
  }
}

/** @param {string} name */
function keepSession(name) {
  try {
    sessionStorage.setItem("elvis-session", name);
  } catch {
    // The session is lost when the frame is loaded anew.
  }
}

export class Connection {
  /** @param {{message: (m: Message) => void, bytes: (facts: Message, bytes: Uint8Array) => void, line: (text: string) => void}} listener */
  constructor(listener) {
    this.listener = listener;
    this.token = new URLSearchParams(location.search).get("token") ?? "";
    /** @type {Map<number, {done: (m: Message) => void, failed: (e: Error) => void}>} */
    this.waiting = new Map();
    this.number = 0;
    this.failures = 0;
    this.ended = false;
    /** @type {WebSocket | null} */
    this.socket = null;
  }

  open() {
    // Relative to the page, so that it does not matter where a proxy has put it.
    const url = new URL("session", location.href.replace(/^http/, "ws"));
    url.search = new URLSearchParams({token: this.token, session: sessionName()}).toString();
    url.hash = "";
    const socket = new WebSocket(url);
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onmessage = (event) => this.receive(event.data);
    socket.onclose = () => this.closed(socket);
  }

  /** @param {string | ArrayBuffer} data */
  receive(data) {
    this.failures = 0;
    if (typeof data === "string") {
      this.dispatch(JSON.parse(data), null);
      return;
    }
    const length = new DataView(data).getUint32(0, true);
    const facts = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
    this.dispatch(facts, new Uint8Array(data, 4 + length));
  }

  /** @param {Message} message @param {Uint8Array | null} bytes */
  dispatch(message, bytes) {
    const asked = message.id === undefined || message.id === null ? undefined : this.waiting.get(message.id);
    if (asked) {
      this.waiting.delete(message.id);
      if (message.type === "error") {
        asked.failed(new Error(message.text));
      } else {
        asked.done({...message, bytes});
      }
      return;
    }
    if (message.type === "hello") {
      keepSession(message.session);
      this.listener.line("");
    } else if (message.type === "taken") {
      this.ended = true;
      this.socket?.close();
    }
    if (bytes) {
      this.listener.bytes(message, bytes);
    } else {
      this.listener.message(message);
    }
  }

  /** @param {WebSocket} socket */
  closed(socket) {
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
    this.listener.line("connection lost, trying again");
    const wait = retryMilliseconds[Math.min(this.failures++, retryMilliseconds.length - 1)];
    setTimeout(() => this.open(), wait);
  }

  /**
   * Without an answer.
   * @param {Message} message
   */
  tell(message) {
    if (this.socket?.readyState === WebSocket.OPEN) {
      this.socket.send(JSON.stringify(message));
    }
  }

  /** @param {Message} message @returns {Promise<Message>} */
  ask(message) {
    return new Promise((done, failed) => {
      if (this.socket?.readyState !== WebSocket.OPEN) {
        failed(new Error("there is no connection"));
        return;
      }
      const id = ++this.number;
      this.waiting.set(id, {done, failed});
      this.tell({...message, id});
    });
  }
}

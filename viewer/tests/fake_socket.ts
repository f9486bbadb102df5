/** A socket that a test speaks through. */
export class FakeSocket {
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onclose: ((event: { reason: string }) => void) | null = null;
  isClosed = false;
  readonly sent: object[] = [];

  hear(message: object): void {
    this.onmessage?.({ data: message instanceof ArrayBuffer ? message : JSON.stringify(message) });
  }
  send(text: string): void {
    this.sent.push(JSON.parse(text) as object);
  }
  close(): void {
    this.isClosed = true;
  }
}

/** All that are opened from now on. */
export function fakeSockets(): FakeSocket[] {
  const sockets: FakeSocket[] = [];
  const open = class extends FakeSocket {
    constructor() {
      super();
      sockets.push(this);
    }
  };
  Object.defineProperty(globalThis, "WebSocket", { value: open, configurable: true });
  return sockets;
}

// The worker that computes, and what is done if it fails. README.md has the messages.

const kPatience = 1000; // ms that a stop may take

/** `report(message)` takes the messages of the worker; those of kind `failed` come at most once per worker. */
export class Engine {
  #worker = null;
  #options = {};
  #lastPing = 0;
  #stopTimer = 0;

  constructor(report, makeWorker = () => new Worker('engine.js', { type: 'module' })) {
    this.report = report;
    this.makeWorker = makeWorker;
  }

  /** `options` are those of the message `start`; a new worker starts at once with the same compiled module. */
  start(options) {
    this.#options = options;
    this.restart();
  }

  restart() {
    clearTimeout(this.#stopTimer);
    this.#worker?.terminate();
    let worker;
    const fail = (text) => {
      if (worker !== this.#worker) return;
      this.end();
      this.report({ from: 'failed', kind: 'defect', text });
    };
    try {
      worker = this.makeWorker();
    } catch (error) {
      return this.report({ from: 'failed', kind: 'absent', text: error.message });
    }
    this.#worker = worker;
    worker.onerror = (event) => {
      event.preventDefault();
      fail(event.message ?? 'it cannot be loaded');
    };
    worker.onmessage = ({ data }) => {
      if (worker !== this.#worker) return;
      if (data.from === 'pong') {
        if (data.id === this.#lastPing) clearTimeout(this.#stopTimer);
      } else if (data.from === 'failed') {
        this.end();
        this.report(data);
      } else {
        this.report(data);
      }
    };
    this.post({ to: 'start', ...this.#options });
  }

  end() {
    clearTimeout(this.#stopTimer);
    this.#worker?.terminate();
    this.#worker = null;
  }

  post(message) {
    this.#worker?.postMessage(message);
  }

  /** Ends the render. `onSilence` is called if the worker does not answer. */
  stop(onSilence) {
    this.post({ to: 'stop' });
    this.post({ to: 'ping', id: ++this.#lastPing });
    clearTimeout(this.#stopTimer);
    this.#stopTimer = setTimeout(onSilence, kPatience);
  }
}

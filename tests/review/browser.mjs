// A headless Chromium, driven through the DevTools protocol over a pipe: no port, no package.
import {spawn} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

export class Browser {
  constructor(program, more = []) {
    this.profile = mkdtempSync(join(tmpdir(), 'telestrain_browser_'));
    // A sandbox needs rights that containers lack; the page is our own and has no network.
    this.process = spawn(program, [
      '--headless=new', '--no-sandbox', '--remote-debugging-pipe', '--no-first-run',
      '--disable-dev-shm-usage', '--disable-background-networking', '--hide-scrollbars',
      '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      `--user-data-dir=${this.profile}`, ...more, 'about:blank'
    ], {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
    this.next = 1;
    this.waiting = new Map();
    this.events = [];
    let rest = Buffer.alloc(0);
    this.process.stdio[4].on('data', (chunk) => {
      rest = Buffer.concat([rest, chunk]);
      for (let end = rest.indexOf(0); end >= 0; end = rest.indexOf(0)) {
        this.receive(JSON.parse(rest.subarray(0, end).toString()));
        rest = rest.subarray(end + 1);
      }
    });
    this.process.on('exit', () => {
      for (const {reject} of this.waiting.values()) reject(new Error('the browser ended'));
    });
  }

  receive(message) {
    const waiting = this.waiting.get(message.id);
    if (!waiting) return this.events.push(message);
    this.waiting.delete(message.id);
    if (message.error) waiting.reject(new Error(JSON.stringify(message.error)));
    else waiting.resolve(message.result);
  }

  send(method, params = {}) {
    const id = this.next++;
    const message = {id, method, params, sessionId: this.session};
    this.process.stdio[3].write(JSON.stringify(message) + '\0');
    return new Promise((resolve, reject) => this.waiting.set(id, {resolve, reject}));
  }

  // A page of this size with the network off; the events of its console and network are kept.
  async open(url, width, height) {
    const {targetInfos} = await this.send('Target.getTargets');
    const {targetId} = targetInfos.find((info) => info.type === 'page');
    const {sessionId} = await this.send('Target.attachToTarget', {targetId, flatten: true});
    this.session = sessionId;
    for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await this.send(`${domain}.enable`);
    await this.send('Network.emulateNetworkConditions',
                    {offline: true, latency: 0, downloadThroughput: 0, uploadThroughput: 0});
    await this.resize(width, height);
    await this.send('Page.navigate', {url});
    await this.until(() => this.events.some((event) => event.method === 'Page.loadEventFired'));
  }

  resize(width, height) {
    return this.send('Emulation.setDeviceMetricsOverride',
                     {width, height, deviceScaleFactor: 1, mobile: false});
  }

  async evaluate(expression) {
    const {result, exceptionDetails} = await this.send(
        'Runtime.evaluate', {expression, returnByValue: true, awaitPromise: true});
    if (exceptionDetails)
      throw new Error(`${expression}: ${JSON.stringify(exceptionDetails.exception)}`);
    return result.value;
  }

  async until(condition) {
    for (let i = 0; i < 1200; ++i) {
      if (condition()) return;
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    throw new Error(`never true: ${condition}`);
  }

  async mouse(type, x, y, more = {}) {
    await this.send('Input.dispatchMouseEvent',
                    {type, x, y, button: 'left', buttons: type === 'mouseReleased' ? 0 : 1,
                     clickCount: 1, ...more});
  }

  async click(x, y) {
    await this.mouse('mousePressed', x, y);
    await this.mouse('mouseReleased', x, y);
  }

  async drag(from, to) {
    await this.mouse('mousePressed', ...from);
    await this.mouse('mouseMoved', ...to);
    await this.mouse('mouseReleased', ...to);
  }

  async key(key) {
    for (const type of ['keyDown', 'keyUp'])
      await this.send('Input.dispatchKeyEvent', {type, key, code: key});
  }

  async screenshot(whole = false) {
    const {data} = await this.send('Page.captureScreenshot', {captureBeyondViewport: whole});
    return Buffer.from(data, 'base64');
  }

  // Messages of the console that are warnings or worse, exceptions, and requests beyond the page.
  complaints(url) {
    return this.events.flatMap(({method, params}) => {
      if (method === 'Runtime.exceptionThrown')
        return [`exception: ${params.exceptionDetails.exception?.description}`];
      if (method === 'Runtime.consoleAPICalled' && ['error', 'warning', 'assert'].includes(params.type))
        return [`console: ${params.args.map((arg) => arg.value ?? arg.description).join(' ')}`];
      if (method === 'Log.entryAdded' && ['error', 'warning'].includes(params.entry.level))
        return [`log: ${params.entry.text}`];
      if (method === 'Network.requestWillBeSent' && params.request.url !== url &&
          !params.request.url.startsWith('data:'))
        return [`request: ${params.request.url}`];
      return [];
    });
  }

  // Its profile is removed once it has ended, because it writes to it until then.
  async close() {
    const ended = new Promise((resolve) => this.process.on('exit', resolve));
    const late = setTimeout(() => this.process.kill('SIGKILL'), 10000);
    this.session = undefined;
    this.send('Browser.close').catch(() => {});
    await ended;
    clearTimeout(late);
    rmSync(this.profile, {recursive: true, force: true, maxRetries: 20, retryDelay: 100});
  }
}

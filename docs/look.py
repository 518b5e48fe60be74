# SPDX-License-Identifier: GPL-3.0-or-later
"""Photographs pages in a browser without a window, and says what they cost.

    python3 docs/look.py OUT PAGE.html ...

Each page at 420, 1000 and 1600 pixels, light, dark and printed, as OUT/PAGE-WIDTH-SCHEME.png; of each one line with
its size, nodes, time in scripts and in layout and styles (the browser's Performance domain), and what is wrong."""
import base64
import json
import os
import shutil
import subprocess
import sys
import tempfile

WIDTHS = 420, 1000, 1600
SCHEMES = 'light', 'dark', 'print'
OPTIONS = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--disable-quic', '--no-first-run', '--hide-scrollbars',
           '--disable-background-networking', '--disable-component-update', '--disable-sync', '--disable-extensions', '--remote-debugging-pipe']
TALLEST = 16000  # pixels that the browser photographs at once


class Browser:
    """Speaks the DevTools protocol over two pipes."""

    def __init__(self):
        self.profile = tempfile.mkdtemp()
        to, self.write = os.pipe()
        self.read, back = os.pipe()
        self.process = subprocess.Popen(  # it reads its commands from 3 and answers on 4
            ['bash', '-c', f'exec chromium "$@" 3<&{to} 4>&{back}', 'chromium', *OPTIONS, '--user-data-dir=' + self.profile],
            pass_fds=(to, back), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to)
        os.close(back)
        self.rest, self.number, self.session, self.said, self.seen = b'', 0, None, [], set()
        self.target = None

    def close(self):
        self.process.terminate()
        self.process.wait()
        shutil.rmtree(self.profile, ignore_errors=True)

    def next(self):
        while b'\0' not in self.rest:
            more = os.read(self.read, 1 << 20)
            if not more:
                sys.exit('Chromium ended')
            self.rest += more
        line, self.rest = self.rest.split(b'\0', 1)
        message = json.loads(line)
        method = message.get('method', '')
        if method == 'Runtime.exceptionThrown':
            self.said.append(message['params']['exceptionDetails']['text'])
        elif method == 'Runtime.consoleAPICalled' or method == 'Log.entryAdded':
            self.said.append(json.dumps(message['params'])[:200])
        self.seen.add(method)
        return message

    def ask(self, method, **params):
        self.number += 1
        message = {'id': self.number, 'method': method, 'params': params}
        if self.session:
            message['sessionId'] = self.session
        os.write(self.write, json.dumps(message).encode() + b'\0')
        while True:
            answer = self.next()
            if answer.get('id') == self.number:
                if 'error' in answer:
                    sys.exit(f'{method}: {answer["error"]["message"]}')
                return answer['result']

    def value(self, expression):
        return self.ask('Runtime.evaluate', expression=expression, awaitPromise=True, returnByValue=True)['result'].get('value')

    def fresh(self):
        """A new tab, whose times begin at 0."""
        self.session, old = None, self.target
        self.target = self.ask('Target.createTarget', url='about:blank')['targetId']
        if old:
            self.ask('Target.closeTarget', targetId=old)
        self.session = self.ask('Target.attachToTarget', targetId=self.target, flatten=True)['sessionId']
        for domain in 'Page', 'Runtime', 'Log', 'Performance':
            self.ask(domain + '.enable')

    def open(self, url, width=1000, scripts=True):
        """Opens a page, and waits for what its script says last."""
        self.fresh()
        self.ask('Emulation.setScriptExecutionDisabled', value=not scripts)
        self.ask('Emulation.setDeviceMetricsOverride', width=width, height=900, deviceScaleFactor=1, mobile=False)
        self.said, self.seen = [], set()
        self.ask('Page.navigate', url=url)
        while 'Page.loadEventFired' not in self.seen:
            self.next()
        if scripts:
            self.value('new Promise(function wait(done) { document.body.dataset.ready || performance.now() > 6e4 ? done() : setTimeout(wait, 20, done); })')

    def dress(self, width, scheme):
        """Gives the open page another width and scheme; a page draws its figures anew for either."""
        self.ask('Emulation.setEmulatedMedia', media='print' if scheme == 'print' else '',
                 features=[{'name': 'prefers-color-scheme', 'value': 'dark' if scheme == 'dark' else 'light'}])
        self.ask('Emulation.setDeviceMetricsOverride', width=width, height=900, deviceScaleFactor=1, mobile=False)
        event = 'beforeprint' if scheme == 'print' else 'afterprint'
        self.value(f'dispatchEvent(new Event("{event}")), new Promise(function (done) {{ setTimeout(done, 50); }})')

    def photograph(self, path):
        height = min(TALLEST, self.value('Math.ceil(document.documentElement.getBoundingClientRect().height)'))
        width = self.value('innerWidth')
        self.ask('Emulation.setDeviceMetricsOverride', width=width, height=height, deviceScaleFactor=1, mobile=False)
        picture = self.ask('Page.captureScreenshot', format='png', clip={'x': 0, 'y': 0, 'width': width, 'height': height, 'scale': 1},
                           captureBeyondViewport=True)['data']
        with open(path, 'wb') as out:
            out.write(base64.b64decode(picture))

    def cost(self):
        return {m['name']: m['value'] for m in self.ask('Performance.getMetrics')['metrics']}


def wrong(browser):
    """What a reader would stumble over: errors, and content that is wider than the window."""
    found = list(browser.said)
    if browser.value('document.documentElement.scrollWidth > innerWidth + 1'):
        found.append('wider than the window')
    return found


def main():
    out, pages = sys.argv[1], sys.argv[2:]
    os.makedirs(out, exist_ok=True)
    print(f'{"page":28} {"kB":>6} {"nodes":>6} {"script ms":>9} {"layout ms":>9}')
    browser = Browser()
    for page in pages:
        name = os.path.splitext(os.path.basename(page))[0]
        name = os.path.basename(os.path.dirname(os.path.abspath(page))) if name == 'report' else name
        browser.open('file://' + os.path.abspath(page))
        cost, nodes = browser.cost(), browser.value('document.getElementsByTagName("*").length')
        layout = 1e3 * (cost['LayoutDuration'] + cost['RecalcStyleDuration'])
        print(f'{name:28} {os.path.getsize(page) / 1e3:6.0f} {nodes:6} {1e3 * cost["ScriptDuration"]:9.0f} {layout:9.0f}', flush=True)
        for width in WIDTHS:
            for scheme in SCHEMES:
                browser.dress(width, scheme)
                browser.photograph(f'{out}/{name}-{width}-{scheme}.png')
                for fault in wrong(browser):
                    print(f'  {width} {scheme}: {fault}')
    browser.close()


if __name__ == '__main__':
    main()

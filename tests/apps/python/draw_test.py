"""The page of `rugosa target --draw` in Chromium, by events of mouse and finger (DevTools protocol)."""

import json
import os
import re
import shutil
import subprocess
import tempfile
import time
import unittest

from common import WithFolder

LIMITS = re.compile(r"no similarity is above ([-0-9.e]+)")


class Browser:
    """A headless Chromium with one page. Messages are JSON that ends with a zero, through two pipes."""

    def __init__(self, page, downloads):
        commands, self.commands = os.pipe()
        self.answers, answers = os.pipe()
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.process = subprocess.Popen(
            ["sh", "-c", "exec chromium --headless --no-sandbox --disable-gpu --remote-debugging-pipe "
             f"--window-size=1000,1400 --user-data-dir='{self.profile.name}' 3<&{commands} 4>&{answers}"],
            pass_fds=(commands, answers), stderr=subprocess.DEVNULL)
        os.close(commands), os.close(answers)
        self.pending, self.last, self.session, self.log = b"", 0, {}, []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = {"sessionId": self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]}
        self.call("Runtime.enable")
        self.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(downloads))
        self.call("Page.navigate", url=page.as_uri())
        while self.value("document.readyState") != "complete" or not self.value("!!document.getElementById('plot')"):
            time.sleep(0.02)

    def close(self):
        self.process.terminate()
        self.process.wait(20)
        os.close(self.commands), os.close(self.answers)
        self.profile.cleanup()

    def call(self, method, **parameters):
        self.last += 1
        message = {"id": self.last, "method": method, "params": parameters, **self.session}
        os.write(self.commands, json.dumps(message).encode() + b"\0")
        while True:
            while b"\0" not in self.pending:
                more = os.read(self.answers, 1 << 16)
                if not more:
                    raise RuntimeError("Chromium has ended")
                self.pending += more
            text, self.pending = self.pending.split(b"\0", 1)
            answer = json.loads(text)
            if answer.get("method") in ("Runtime.exceptionThrown", "Runtime.consoleAPICalled"):
                self.log.append(answer["params"])
            if answer.get("id") == self.last:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]

    def value(self, script):
        return self.call("Runtime.evaluate", expression=script, returnByValue=True)["result"].get("value")

    def type(self, **fields):
        for field, text in fields.items():
            self.value(f"{{ const one = document.getElementById('{field}'); one.value = '{text}';"
                       f"one.dispatchEvent(new Event('{'change' if field == 'quantity' else 'input'}')) }}")

    def click(self, button):
        x, y = self.value(f"(() => {{ const one = document.getElementById('{button}'); one.scrollIntoView();"
                          "const box = one.getBoundingClientRect(); return [box.x + 5, box.y + 5] })()")
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def draw(self, curve, finger=False, steps=40):
        """Draws the height curve(share of x) over the whole axis, both 0 to 1, with the mouse or a finger."""
        left, top, width, height = self.value(
            "(() => { document.getElementById('clear').click(); document.getElementById('plot').scrollIntoView();"
            "const box = document.getElementById('frame').getBoundingClientRect();"
            "return [box.x, box.y, box.width, box.height] })()")
        places = [(left + width * i / steps, top + height * (1 - curve(i / steps))) for i in range(steps + 1)]
        for i, (x, y) in enumerate(places + places[-1:]):
            kind = 0 if i == 0 else 2 if i > steps else 1
            if finger:
                self.call("Input.dispatchTouchEvent", type=("touchStart", "touchMove", "touchEnd")[kind],
                          touchPoints=[] if kind == 2 else [{"x": x, "y": y}])
            else:
                self.call("Input.dispatchMouseEvent", type=("mousePressed", "mouseMoved", "mouseReleased")[kind],
                          x=x, y=y, button="left", buttons=1, clickCount=1)


@unittest.skipUnless(shutil.which("chromium"), "skipped: Chromium is not installed")
class Draw(WithFolder):
    def setUp(self):
        super().setUp()
        self.rugosa("target", "--draw", "mine.html")
        self.browser = Browser(self.folder / "mine.html", self.folder)
        self.addCleanup(self.browser.close)

    def tearDown(self):
        self.assertEqual(self.browser.log, [])
        self.assertEqual(self.browser.value("performance.getEntriesByType('resource').length"), 0)

    def expect(self, state, words=""):
        self.assertEqual(self.browser.value("document.getElementById('verdict').dataset.state"), state, self.verdict())
        self.assertIn(words, self.verdict())

    def verdict(self):
        return self.browser.value("document.getElementById('verdict').innerText")

    def check(self, code):
        """Saves the curve; the program gives this exit code and the limits of similarity that the page gives."""
        saved = self.folder / "mine.csv"
        saved.unlink(missing_ok=True)
        self.browser.click("save")
        end = time.monotonic() + 20
        while not saved.exists() and time.monotonic() < end:
            time.sleep(0.02)
        self.assertEqual(saved.read_text(), self.browser.value("document.getElementById('csv').value"))
        done = self.rugosa("target", "--check", "mine.csv", code=(code,))
        numbers = [sorted(map(float, LIMITS.findall(text))) for text in (done.stdout, self.verdict())]
        self.assertEqual(*map(len, numbers), done.stdout + self.verdict())
        for program, page in zip(*numbers):
            self.assertAlmostEqual(program, page, delta=2e-4)

    def test_stiffness(self):
        page = self.browser
        page.draw(lambda x: 0.3 + 0.3 * x ** 0.5)
        self.expect("open")
        self.check(0)
        rows = (self.folder / "mine.csv").read_text().splitlines()
        self.assertEqual(rows[0], "pressure_MPa,stiffness_MPa_per_mm")  # it records no body
        self.assertEqual(len(rows), 21)
        page.type(band=2, points=50)
        self.expect("open")
        self.check(0)

        page.type(band=0, points=20)
        page.draw(lambda x: 0.6 - 0.2 * x, finger=True)
        self.expect("out-of-reach", "falls from")
        self.check(3)
        page.click("correct")
        self.expect("open")
        self.check(0)

        page.type(top=3)
        page.draw(lambda x: 0.9)
        self.expect("out-of-reach", "above that of full contact")
        self.check(3)
        page.type(points=1)
        self.expect("incomplete", "Points")

    def test_load(self):
        page = self.browser
        page.type(quantity="load")
        page.draw(lambda x: 0.3 * x + 0.2 * x ** 2)
        page.click("correct")
        self.expect("open")
        self.check(0)
        page.draw(lambda x: 0.4 * x ** 0.5, finger=True)
        self.expect("out-of-reach", "convex")
        self.check(3)
        page.click("correct")
        self.expect("open")

    def test_area(self):
        page = self.browser
        page.type(quantity="area", top=1.2)
        page.draw(lambda x: 0.95 * x + 0.01)
        self.expect("invalid", "full contact")
        self.assertTrue(page.value("document.getElementById('save').disabled"))
        page.type(top=1)
        self.expect("open")
        self.check(0)

    def test_caps(self):
        page = self.browser
        page.type(quantity="area", to=0.01, top=0.1, number=16, radius=0.526, modulus=1.36)
        self.expect("incomplete", "Nominal area")
        page.type(area=36)
        # A_one = pi (3 F R/(4 E*))^(2/3) at the end of the axis, over the end of the other axis
        one = 3.141592653589793 * (3 * 0.01 * 36 * 0.526 / (4 * 1.36)) ** (2 / 3) / 36 / 0.1
        for ratio, state, words in ((1.8, "open", "permit 1 to N^(1/3) = 2.52"),
                                    (3, "out-of-reach", "above N^(1/3) A_one"), (0.5, "out-of-reach", "below A_one")):
            page.draw(lambda x: ratio * one * x ** (2 / 3))
            self.expect(state, words)


if __name__ == "__main__":
    unittest.main()

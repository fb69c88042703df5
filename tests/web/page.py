#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plays the page of `cmake --preset web` in Chromium and compares it with the native programs.

    page.py PAGE PROGRAMS [--recordings N | --game]    a line per failure; exits with 0 or 1

PAGE is the folder of the page, PROGRAMS that of the native programs.
"""
import argparse
import json
import random
import re
import sys
import tempfile
from base64 import b64decode
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import png
from visit import Visit, has_colours, native

DEMOS = ("jump", "cannon", "platformer", "cloth", "integrator_race", "stability_map", "jump_rates",
         "galton", "bounce", "projectile", "spring_damper", "hello")
PLAYED_SCENES = ("jump", "orbit", "cloth", "pegs", "tiles", "wind")
SCENES = Path(__file__).resolve().parents[2] / "assets/scenes"
MARKUP = "<img src=x onerror=executed=1><script>executed=1</script>"


def first_pictures(visit):
    for link in (*DEMOS, *(f"scene={name}.toml" for name in PLAYED_SCENES)):
        visit.play(link)
        visit.expect(visit.browser.value("document.title") != "Oiler", f"{link}: no title")
    visit.play("", "index.html")
    cards = visit.browser.value("[...document.querySelectorAll('.cards a')].map(a => a.href)")
    visit.expect(len(cards) == len(DEMOS) + len(list(SCENES.glob("*.toml"))), f"cards: {cards}")


def game(visit):
    """The page of one game begins with it; its bits are those of the native program."""
    visit.open("", "index.html")
    visit.wait("location.pathname === '/play.html' && document.readyState === 'complete'", "the game")
    visit.wait_picture(has_colours, "a picture")
    visit.wait("find('line').textContent !== ''", "a line on the timestep")
    visit.click("bits")
    report = native(visit.programs, "project_game", "--steps", 600, "--json", "-").stdout
    visit.wait(f"find('said').textContent.includes('{json.loads(report)['state_hash']}')", "its bits")


def layout(visit):
    for link, page in (("", "index.html"), ("platformer", "play.html"),
                       ("scene=jump.toml", "play.html")):
        for width, height in ((1280, 720), (390, 844)):
            visit.browser.resize(width, height, is_phone=width < 500)
            visit.play(link, page)
            wide = visit.browser.value("document.documentElement.scrollWidth")
            visit.expect(wide <= width, f"{page}#{link} is {wide} wide of {width}")
            small = visit.browser.value("""[...document.querySelectorAll('button, select')]
                .filter(e => e.checkVisibility() && e.offsetHeight < 44).map(e => e.textContent)""")
            visit.expect(width > 500 or not small, f"too small to touch: {small}")
    visit.browser.resize(1280)


def pictures(visit):
    """The first picture of a demo is the native one, but for the smoothing of its edges."""
    visit.browser.resize(1280, 1500)
    visit.before_scripts("""const {getContext} = HTMLCanvasElement.prototype;
        HTMLCanvasElement.prototype.getContext = function(kind, options) {
            return getContext.call(this, kind, {...options, preserveDrawingBuffer: true}); }""")
    for demo in DEMOS:
        visit.play(demo)
        visit.browser.value("void play(['--no-line', '--frames', '1'])")
        visit.wait("find('said').textContent.includes('ended')", f"the end of {demo}")
        address = visit.browser.value("find('canvas').toDataURL()")
        drawn = png.decode(b64decode(address.split(",")[1]))
        folder = visit.folder / f"{demo}_picture"
        native(visit.programs, demo, "--headless", "--frames", 1, "--size",
               f"{drawn.width}x{drawn.height}", "--out", folder)
        expected = png.decode((folder / "frame_000000.png").read_bytes())
        far = sum(abs(a - b) > 8 for rows in zip(drawn.rows, expected.rows) for a, b in zip(*rows))
        visit.expect(far < 1e-4 * 3 * drawn.width * drawn.height, f"{demo}: {far} bytes differ")


def settings(visit):
    browser = visit.browser
    visit.play("jump")
    browser.press("ArrowLeft", code="ArrowLeft")
    visit.wait_setting("semi_implicit_euler@144", "the key Left")
    knob = visit.knob()
    browser.mouse("mousePressed", knob)
    browser.mouse("mouseMoved", (knob[0] - 150, knob[1]), held=True)
    visit.wait("find('rate').value < 144", "the mouse drags the slider")
    browser.mouse("mouseReleased", (knob[0] - 150, knob[1]))
    visit.fill("rate", "120")
    visit.wait_setting("semi_implicit_euler@120", "the field of the rate")
    visit.wait("find('method').options.length > 30", "the list of methods")
    visit.choose("method", "rk4")
    visit.wait_setting("rk4@120", "the choice of the method")
    visit.wait("location.hash === '#jump&setting=rk4@120'", "the link of the setting")
    visit.play("jump&setting=rk4@120")
    visit.wait_setting("rk4@120", "the setting of the link")
    visit.click("copy")
    visit.wait("find('said').textContent.includes('ink')", "an answer to Copy link")
    visit.wait("location.hash === '#jump&setting=rk4@120'", "the copied link")


def loop_keys(visit):
    visit.play("spring_damper")
    visit.click("pause")
    visit.wait("find('pause').ariaPressed === 'true'", "the pause")
    still = visit.picture()
    visit.expect(visit.picture() == still, "the pause moves")
    visit.browser.click("document.querySelector('[data-code=F5]')")
    visit.wait_picture(lambda now: now != still, "a step changes the picture")
    visit.browser.press("F3", code="F3")
    visit.wait("find('pause').ariaPressed === 'false'", "the key F3")
    visit.browser.press("F3", code="F3")
    visit.wait("find('pause').ariaPressed === 'true'", "the pause")
    still = visit.picture()
    visit.browser.click("document.querySelector('[data-code=F1]')")
    visit.wait_picture(lambda now: now != still, "the inspector opens")


def touch(visit):
    visit.browser.resize(390, 844, is_phone=True)
    visit.play("jump")
    knob = visit.knob()
    visit.browser.touch("touchStart", knob)
    visit.browser.touch("touchMove", (knob[0] - 60, knob[1]))
    visit.wait("find('rate').value < 240", "a finger drags the slider")
    visit.browser.touch("touchEnd")
    visit.play("cannon")
    before = visit.still_picture()
    visit.tap("document.querySelector('[data-code=Space]')")
    visit.wait_picture(lambda now: now != before, "the button Space of the page fires")


def full_screen(visit):
    """Also after the browser has ended it; a refusal is told."""
    visit.play("hello")
    menu = "find('canvas').dispatchEvent(new MouseEvent('contextmenu', {cancelable: true}))"
    visit.expect(not visit.browser.value(menu), "the right button opens the browser's menu")
    for _ in range(2):
        visit.browser.click("document.querySelector('[data-code=F11]')")
        visit.wait("document.fullscreenElement === find('canvas')", "a full screen")
        visit.browser.value("document.exitFullscreen()")
        visit.wait("document.fullscreenElement === null", "its end")
    visit.browser.value("void (find('canvas').requestFullscreen = () => Promise.reject())")
    visit.browser.click("document.querySelector('[data-code=F11]')")
    visit.wait("find('said').textContent.includes('refuses')", "the refusal")


def pads(visit):
    """The first pad of the standard layout plays, another one does not."""
    visit.before_scripts("""const pad = mapping => ({id: 'pad', mapping, connected: true, index: 1,
            timestamp: 0, axes: [0, 0, 0, 0], buttons: Array.from({length: 17},
            () => ({pressed: false, touched: false, value: 0}))});
        const pads = [null, pad(''), pad('standard'), null];
        navigator.getGamepads = () => pads;""")
    visit.play("cannon")
    before = visit.still_picture()
    visit.browser.value("pads[1].buttons[0].pressed = true")
    visit.sleep(0.5)
    visit.expect(visit.picture() == before, "a pad of an unknown layout plays")
    visit.browser.value("pads[2].buttons[0].pressed = true")
    visit.wait_picture(lambda now: now != before, "the pad's button fires")


def bits(visit):
    visit.play("jump")
    for name in (*DEMOS, *(scene.name for scene in SCENES.glob("*.toml"))):
        steps = ["--steps", "600", "--quiet", "--json", "-"]
        on_page = [name, *steps] if name in DEMOS else ["oiler", "play", f"/scenes/{name}", *steps]
        own = [name] if name in DEMOS else ["oiler", "play", str(SCENES / name)]
        expected = json.loads(native(visit.programs, *own, *steps).stdout)["state_hash"]
        result = visit.run(*on_page)
        actual = result["output"] and json.loads("".join(result["output"]))["state_hash"]
        visit.expect(actual == expected,
                     f"{name}: {actual}, natively {expected}; {result['failure']}")
    for link in ("hello", "scene=jump.toml"):
        visit.play(link)
        visit.click("bits")
        visit.wait("find('said').textContent.includes('equal to the native')", f"bits of {link}")


def script(game, dice):
    """Random keys of a game, for --script, and how many steps they take."""
    keys = {"hello": ["Space"], "jump": ["Left", "Right"], "jump_rates": ["Space", "Left"],
            "platformer": ["Space", "Right", "E"]}[game]
    steps = sorted(dice.sample(range(5, 80), 6))
    return "".join(f"{step} press {dice.choice(keys)}\n" for step in steps), dice.randint(90, 150)


def native_recordings(visit, count):
    dice = random.Random(1)
    for i in range(count):
        game = dice.choice(("hello", "jump", "jump_rates", "platformer"))
        text, steps = script(game, dice)
        (visit.folder / "keys.txt").write_text(text)
        file = visit.folder / f"{game}_{i}.rec"
        native(visit.programs, game, "--script", visit.folder / "keys.txt", "--steps", steps,
               "--record", file)
        visit.play("cannon")
        visit.give_file(file)
        visit.wait(f"find('said').textContent.includes('{steps} of {steps} steps')",
                   f"the page replays {file.name}")


def page_recordings(visit, count):
    dice = random.Random(2)
    for i in range(count):
        game = dice.choice(("hello", "jump", "platformer"))
        visit.play(game)
        visit.click("record")
        visit.wait("playing.isRecording", "a recording")
        for _ in range(dice.randint(3, 8)):
            key, code = dice.choice(((" ", "Space"), ("ArrowLeft",) * 2, ("ArrowRight",) * 2))
            visit.browser.press(key, code=code)
            visit.sleep(dice.uniform(0.05, 0.4))
        file = visit.download(lambda: visit.click("record"), f"{game}.rec")
        answer = native(visit.programs, game, "--replay", file, "--steps", 100000)
        visit.expect(answer.returncode == 0 and "the replay equals" in answer.stderr,
                     f"{game} does not replay {i}: {answer.stderr}")
        file.unlink()


def recording_is_left(visit):
    """A recording that a dropped one ends is saved under its game's name; the dropped one plays."""
    file = visit.folder / "other.rec"
    native(visit.programs, "jump", "--steps", 30, "--record", file)
    visit.play("hello")
    visit.click("record")
    visit.wait("playing.isRecording", "a recording")
    saved = visit.download(lambda: visit.drop_file(file), "hello.rec")
    visit.wait("find('title').textContent === 'jump'", "the dropped recording")
    visit.wait("location.hash.startsWith('#jump&setting=')", "the setting in the link")
    answer = native(visit.programs, "hello", "--replay", saved, "--steps", 100000)
    visit.expect("the replay equals" in answer.stderr, f"hello.rec: {answer.stderr}")


def setting_is_kept(visit):
    """A setting that the game does not have yet is shown, linked and recorded."""
    visit.play("hello")
    visit.click("pause")
    visit.wait("find('pause').ariaPressed === 'true'", "the pause")
    visit.fill("rate", "45")
    visit.wait("location.hash === '#hello&setting=semi_implicit_euler@45'", "the linked setting")
    visit.sleep(1.2)
    kept = visit.browser.value("[find('pause').ariaPressed, find('rate').value]")
    visit.expect(kept == ["true", "45"], f"a paused game forgets its new rate: {kept}")
    visit.browser.value("""find('rate').value = 30; find('rate').dispatchEvent(new Event('change'));
        find('record').click()""")
    visit.wait("playing.isRecording", "a recording")
    visit.wait_setting("semi_implicit_euler@30", "the rate that was chosen before the recording")
    visit.click("record")
    visit.wait("find('said').textContent.includes('is saved')", "the end of the recording")
    visit.wait_picture(has_colours, "the game after the recording")
    visit.browser.press("Escape", code="Escape")
    visit.wait("find('said').textContent.includes('ended')", "the end")
    visit.browser.press("F9", code="F9")
    visit.wait("playing.module !== null", "F9 after the end")


def another_setting_is_not_native(visit):
    visit.play("scene=jump.toml")
    visit.wait("!find('bits').disabled", "the text of the scene")
    visit.click("bits")
    visit.wait("find('said').textContent.includes('equal to the native')", "the bits")
    visit.choose("method", "rk4")
    visit.wait_setting("rk4@60", "the method")
    visit.click("bits")
    visit.wait("/of rk4 at 60 Hz: \\w{16}\\.$/.test(find('said').textContent)", "the bits of rk4")
    visit.type("[")
    visit.click("bits")
    visit.wait("find('said').textContent.includes('not TOML')", "no bits of no scene")
    visit.browser.value("find('text').value = '#'.repeat(66000)")
    visit.click("copy")
    visit.wait("find('said').textContent.includes('too long')", "no link of a long scene")


def impossible_setting(visit):
    visit.open("scene=cloth.toml&setting=exact@60")
    visit.wait("find('problem').textContent.includes('exact')", "why exact is impossible")
    visit.wait_picture(has_colours, "the scene at its own setting")


def while_it_loads(visit):
    """Nothing can be chosen that would be forgotten."""
    visit.before_scripts("""const {compileStreaming} = WebAssembly;
        WebAssembly.compileStreaming = async (...all) => {
            await new Promise(done => { window.goOn = done; });
            return compileStreaming(...all); }""")
    visit.open("hello&setting=rk4@40")
    visit.wait("'goOn' in window", "the program")
    (visit.folder / "large.toml").write_bytes(b"#" * 70_000)
    visit.give_file(visit.folder / "large.toml")
    visit.sleep(0.5)
    visit.expect(visit.browser.value("find('controls').inert"), "controls before there is a game")
    visit.browser.value("goOn()")
    visit.wait("!find('controls').inert", "the controls")
    visit.wait_setting("rk4@40", "the setting of the link")
    visit.open("nothere")
    visit.wait("find('problem').textContent.includes('no such demo')", "the refusal")
    visit.expect(visit.browser.value("find('controls').inert"), "controls of no game")


def typed_rate(visit):
    visit.play("hello")
    for typed in ("0", "1.5", "9999999", ""):
        visit.fill("rate", typed)
        visit.wait("find('said').textContent.includes('whole number')", f"a rate of {typed}")
        visit.expect(visit.browser.value("find('rate').value") == "60", f"{typed} is left")
    visit.fill("rate", "1e3")
    visit.wait_setting("semi_implicit_euler@1000", "a rate of 1e3")
    visit.type("70", "rate")
    visit.browser.value("listMethods()")  # a list that comes late
    visit.click("restart")
    visit.wait_setting("semi_implicit_euler@70", "a rate that was typed before a restart")
    visit.type("90", "rate")
    visit.fill("rate", "70")
    shown = visit.browser.value("tell('', 'semi_implicit_euler@30', false); find('rate').value")
    visit.expect(shown == "30", "a field that is left is typed")


def lost_context(visit):
    """A game that was paused begins anew in a pause; a recording is saved."""
    lose = """find('canvas').old = true;
        find('canvas').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext()"""
    visit.play("hello")
    visit.click("pause")
    visit.wait("find('pause').ariaPressed === 'true'", "the pause")
    visit.browser.value(lose)
    visit.wait("!find('canvas').old", "a new canvas")
    visit.wait_picture(has_colours, "the picture after a lost context")
    visit.wait("find('said').textContent.includes('anew')", "a word on that")
    visit.wait("find('pause').ariaPressed === 'true'", "the pause of the new game")
    visit.click("record")
    visit.wait("playing.isRecording", "a recording")
    visit.download(lambda: visit.browser.value(lose), "hello.rec")
    visit.wait("find('said').textContent.includes('is saved')", "a word on the recording")


def edits_make_old(visit):
    visit.play("scene=jump.toml")
    visit.wait("!find('bits').disabled", "the text of the scene")
    visit.browser.click("document.querySelector('[data-command=rates]')")
    visit.wait("find('results').ariaBusy === 'false'", "the rates")
    visit.click("bits")
    visit.wait("find('said').textContent.includes('equal to the native')", "the bits")
    visit.type((SCENES / "jump.toml").read_text().replace("9.0", "8.0"))
    visit.expect(visit.text("said") == "", "the verdict on the bits of another scene")
    visit.expect(visit.text("title") == "A scene", "the name of the scene before")
    visit.expect(visit.text("results").startswith("Of the scene before"), "results of another scene")
    visit.browser.click("document.querySelector('[data-command=rates]')")
    visit.expect("complete" not in visit.text("said"), "results are complete before they are there")
    visit.wait("find('said').textContent.includes('complete')", "the rates")
    visit.expect(not visit.text("results").startswith("Of the scene before"), "new results are old")
    visit.browser.click("document.querySelector('[data-command=advise]')")
    visit.type((SCENES / "jump.toml").read_text().replace("9.0", "7.0"))
    visit.wait("find('results').ariaBusy === 'false'", "the advice")
    visit.expect(visit.text("results").startswith("Of the scene before"), "advice for another scene")
    file = visit.folder / "other.rec"
    native(visit.programs, "hello", "--steps", 30, "--record", file)
    visit.give_file(file)
    visit.wait("location.hash === '#hello&setting=semi_implicit_euler@60'", "the link of the replay")
    visit.expect(visit.browser.value("find('lab').hidden"), "results of another game")
    visit.play("scene=jump.toml")
    visit.wait("!find('bits').disabled", "the text of the scene")
    visit.type((SCENES / "jump.toml").read_text().replace("9.0", "8.0"))
    visit.give_file(file)
    visit.sleep(2)
    visit.wait("location.hash === '#hello&setting=semi_implicit_euler@60'", "the link after an edit")


def editor(visit):
    visit.play("scene=jump.toml")
    visit.wait("find('text').value", "the text of the scene")
    text = (SCENES / "jump.toml").read_text()
    visit.expect(visit.browser.value("find('text').value") == text, "another text than the file's")
    for wrong in (text.replace("radius", "radus"), text.replace("axes = 2", "axes = 9"), "["):
        (visit.folder / "scene.toml").write_text(wrong)
        answer = native(visit.programs, "oiler", "play", visit.folder / "scene.toml", "--steps", 0)
        line, words = re.search(r":(\d+): (.*)", answer.stderr).groups()
        visit.type(wrong)
        visit.wait(f"find('mistake').textContent === {json.dumps(f'Line {line}: {words}')}",
                   f"line {line}: {words}")
    visit.type(text.replace("9.0", "7.5").replace("rate = 60", "rate = 90"))
    visit.wait_setting("semi_implicit_euler@90", "the rate of the text")
    visit.expect(visit.text("mistake") == "", f"a mistake in a right text: {visit.text('mistake')}")
    visit.wait("/^#deflated=[^&]+$/.test(location.hash)", "the link of the text")
    visit.choose("method", "rk4")
    visit.wait("location.hash.endsWith('&setting=rk4@90')", "the setting in the link")
    return visit.browser.value("[location.hash.slice(1), find('text').value]")


def link_in_fresh_browser(visit, link, text):
    visit.play(link)
    visit.expect(visit.browser.value("find('text').value") == text, "the link has another text")
    visit.wait_setting("rk4@90", "the setting of the link")


def lab(visit):
    visit.play("scene=jump.toml")
    visit.wait("find('text').value", "the text of the scene")
    visit.browser.click("document.querySelector('[data-command=rates]')")
    visit.wait("find('results').ariaBusy === 'false'", "the rates")
    expected = native(visit.programs, "oiler", "rates", SCENES / "jump.toml").stdout
    visit.expect(expected in visit.text("results"), f"other rates: {visit.text('results')}")
    visit.browser.click("document.querySelector('[data-command=advise]')")
    visit.wait("find('results').ariaBusy === 'false'", "the advice")
    cost = re.search(r"error 0\.(69|7) mm as drawn, .* ([\d.]+) µs per simulated second",
                     visit.text("results"))
    visit.expect(cost and 0 < float(cost[2]) < 1000, f"other advice: {visit.text('results')}")
    visit.play("scene=pegs.toml")
    visit.wait("find('text').value", "the text of the scene")
    visit.browser.click("document.querySelector('[data-command=rates]')")
    visit.wait("find('cancel').checkVisibility()", "a button to cancel")
    visit.click("cancel")
    visit.wait("find('said').textContent === 'Cancelled.'", "the end of the rates")


def hostile(visit):
    """Nothing of a link, a file or its name is executed, and each is answered in one line."""
    scene = f'[scene]\naxes = 2\ntitle = "{MARKUP}"\n[[body]]\nname = "{MARKUP}"\n'
    refused = [("%3Cimg src=x onerror=executed=1%3E", "no such demo or scene"),
               ("__proto__", "no such demo or scene"), ("scene=../../etc/passwd", "no such"),
               ("scene=constructor", "no such"), ("deflated=AAAA", "damaged"),
               ("deflated=" + visit.deflated(b"a" * 50_000_000), "damaged"), ("text=!", "damaged")]
    for link, words in refused:
        visit.open(link)
        visit.wait(f"find('problem').textContent.includes('{words}')", f"{link[:40]}: {words}")
    visit.play("deflated=" + visit.deflated(scene.encode()))
    visit.play("jump&setting=%3Cb%3E@60&setting=--json@60")
    visit.wait_setting("semi_implicit_euler@240", "a hostile setting")
    for name, content, words in (
            (f"{MARKUP.replace('/', '')}.toml", scene.encode(), None),
            ("large.toml", b"#" * 70_000, "64 KiB"),
            ("a.rec", b'OILERREC 3\n{"game":"%s"}\n' % MARKUP.encode(), "not here"),
            ("b.rec", b"OILERREC 3\n", "damaged"),
            ("c.rec", b'OILERREC 3\n{"game":"hello"}\n', "hello: --replay"),
            ("d.toml", MARKUP.encode(), None)):
        (visit.folder / name).write_bytes(content)
        visit.play("jump")
        (visit.drop_file if name.endswith(".toml") else visit.give_file)(visit.folder / name)
        if words:
            visit.wait(f"find('problem').textContent.includes('{words}')", f"{name}: {words}")
            visit.wait("find('title').textContent === 'jump' && !!playing.module", "jump goes on")
        else:
            visit.wait("location.hash.startsWith('#deflated=') && find('text').value", name)
    visit.wait("find('mistake').textContent.startsWith('Line 1')", "markup is no scene")
    visit.give_file(visit.folder / "c.rec")
    visit.wait("find('problem').textContent.includes('hello: --replay')", "a recording after it")
    visit.wait("find('title').textContent === 'A scene' && !find('scene').hidden", "the scene stays")
    visit.play("jump")
    visit.browser.value("""['hello', 'cannon'].map(game => open(
        new File([`OILERREC 3\\n{"game":"${game}"}\\n`], 'two.rec'))), 1""")
    visit.wait("find('problem').textContent.includes('cannon: --replay')", "the second of two files")
    visit.wait("find('title').textContent === 'jump' && !!playing.module", "jump goes on after two")


def as_files(visit, folder):
    for page in ("index.html", "play.html"):
        visit.play("", page, (folder / page).as_uri())
    visit.click("bits")
    visit.wait("find('said').textContent.includes('equal to the native')", "bits from a file")


def lacks(visit):
    """What a browser lacks is told in a line."""
    for script_text, words in (("HTMLCanvasElement.prototype.getContext = () => null", "WebGL 2"),
                               ("delete window.WebAssembly", "WebAssembly")):
        visit.before_scripts(script_text)
        for page in ("play.html", "index.html"):
            visit.open("jump", page)
            visit.wait(f"document.querySelector('#problem').textContent.includes('{words}')", words)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("page", type=Path)
    parser.add_argument("programs", type=Path)
    parser.add_argument("--recordings", type=int, default=3)
    parser.add_argument("--game", action="store_true", help="PAGE is that of one game")
    options = parser.parse_args()
    failures = []
    with tempfile.TemporaryDirectory() as folder, Visit.server(options.page) as origin:
        def visiting(*check):
            with Visit(origin, options.programs.resolve(), Path(folder)) as visit:
                answer = visit.attempt(*check)
                failures.extend(f"{check[0].__name__}: {failure}"
                                for failure in visit.all_failures())
                return answer

        def visit_all():
            for check in (first_pictures, pictures, layout, settings, loop_keys, touch, full_screen,
                          pads, bits, lab, recording_is_left, setting_is_kept,
                          another_setting_is_not_native, impossible_setting, while_it_loads,
                          typed_rate, lost_context, edits_make_old, hostile):
                visiting(check)
            visiting(native_recordings, options.recordings)
            visiting(page_recordings, options.recordings)
            edited = visiting(editor)
            if edited:
                visiting(link_in_fresh_browser, *edited)
            visiting(as_files, options.page.resolve())
            visiting(lacks)

        if options.game:
            visiting(game)
        else:
            visit_all()
    for failure in failures:
        print(" ".join(failure.split()))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

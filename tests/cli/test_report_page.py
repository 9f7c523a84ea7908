"""The page of `jostle report` in a browser: rods that turn, time, colours, plots; offline, on a phone, without WebGL."""

import base64
import re
import shutil
import zlib

import h5py
import numpy as np
import pytest
from selenium.webdriver import ActionChains, Keys

import browser as browsers
from browser import Browser, differing, painted
from jostle_command import RODS, changed, column, command, finish, with_steps, write_scene

STAGE = "#view .stage"
OVERLAYS = ".hint, .axes, .length-bar, .corner { visibility: hidden }"
SAME = 0.03  # of the pixels may differ, at edges: how finely a picture is drawn depends on what else the processor does
COLONY = {
    "seed": 3, "box": {"edges": [60.0, 60.0, 60.0], "periodic": [False, False, False]},
    "rods": {"count": 1, "length": 2.0}, "fluid": {"kT": 0.01},
    "growth": {"rate": 2.0, "rate_deviation": 0.1, "division_length": 5.0},
    "time": {"step": 0.005, "production": 8.0}, "output": {"series_every": 20, "trajectory_every": 80, "stress_per_rod": True},
}


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    made = Browser(tmp_path_factory.mktemp("browser"), *browsers.WEBGL)
    yield made
    made.close()


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Rods, with contacts and stresses in every frame."""
    folder = tmp_path_factory.mktemp("rods")
    write_scene(folder, changed(with_steps(RODS, 2000), output={"trajectory_every": 100, "series_every": 10, "stress_per_rod": True}))
    finish(folder)
    report(folder)
    return folder / "run"


def report(folder, *options):
    result = command(folder, "report", "run", "--width", "120", *options)
    assert result.returncode == 0, result.stderr
    return result.stderr


@pytest.fixture
def page(browser, run):
    """The page of the rods, anew, with nothing in front of them."""
    browser.open(run / "report/report.html")
    return bare(browser)


def bare(browser):
    browser.run("document.head.insertAdjacentHTML('beforeend', `<style>${arguments[0]}</style>`)", OVERLAYS)
    return browser


def rods(page):
    """The picture of the rods, once it is drawn finely."""
    page.run("document.querySelector('#view canvas').dataset.drawn = ''; dispatchEvent(new Event('resize'))")
    page.run("document.querySelector('#view canvas').style.width = document.querySelector('#view canvas').style.width ? '' : '99.99%'")
    page.wait("return document.querySelector('#view canvas').dataset.drawn === 'still'")
    return page.pixels(STAGE)[6:-6, 6:-6]  # without its frame


def choose(page, selector, value):
    page.run("""const select = document.querySelector(arguments[0]); select.value = arguments[1];
                for (const name of ['input', 'change']) select.dispatchEvent(new Event(name))""", selector, value)


def test_rods_are_drawn_and_nothing_is_fetched(page, run):
    page.requested()
    page.open(run / "report/report.html")
    seen = rods(bare(page))
    share = painted(seen).mean()
    assert 0.1 < share < 0.9
    assert len(np.unique((8 * seen[painted(seen)]).astype(int), axis=0)) > 60  # shaded, of many directions
    assert page.errors() == []
    addresses = page.requested()
    assert addresses and all(re.match("file:|data:|blob:", address) for address in addresses)
    assert [address for address in addresses if address.startswith("file:")] == [(run / "report/report.html").resolve().as_uri()]


def test_the_slider_moves_the_rods(page, run):
    last = rods(page)
    times = h5py.File(run / "trajectory.h5")["particles/rods/position/time"][()]
    slider = page.find(".slider")
    assert float(page.find(".time-bar output").text.split()[0]) == pytest.approx(times[-1], rel=1e-3)
    slider.send_keys(Keys.HOME)
    assert float(page.find(".time-bar output").text.split()[0]) == times[0] == 0.0
    first = rods(page)
    assert differing(first, last) > 0.05
    slider.send_keys(Keys.END)
    assert differing(rods(page), last) < SAME


def test_play_goes_through_the_frames(page):
    page.find("#view canvas").click()
    before = page.run("return document.querySelector('.slider').value")
    page.find("#view canvas").send_keys(" ")
    page.wait("return Number(document.querySelector('.slider').value) > 3 && document.querySelector('.slider').value !== arguments[0]", before)
    page.find("#view canvas").send_keys(" ")
    assert page.find(".play").get_attribute("aria-label") == "play"


def test_hand_and_keys_turn_and_zoom(page):
    home = rods(page)
    canvas = page.find("#view canvas")
    ActionChains(page.driver).drag_and_drop_by_offset(canvas, 120, 40).perform()
    turned = rods(page)
    assert differing(home, turned) > 0.1
    canvas.send_keys(Keys.HOME)
    assert differing(home, rods(page)) < SAME
    canvas.send_keys("---")
    assert painted(rods(page)).mean() < 0.6 * painted(home).mean()
    page.run("document.querySelector('.corner button').click()")
    assert differing(home, rods(page)) < SAME
    page.run("""document.querySelector('#view canvas').dispatchEvent(
                  new WheelEvent('wheel', {deltaY: 400, bubbles: true, cancelable: true}))""")
    assert painted(rods(page)).mean() < 0.6 * painted(home).mean()


def test_colours_slab_box_and_forces(page):
    pictures = {}
    for key in page.run("return [...document.querySelectorAll('.colour option')].map((one) => one.value)"):
        choose(page, ".colour", key)
        pictures[key] = rods(page)
    assert set(pictures) == {"direction", "angle", "pressure", "speed", "id", "plain"}
    whole = pictures["plain"]
    for key, picture in pictures.items():
        assert key == "plain" or differing(picture, whole) > 0.05, key
    tint = whole[painted(whole, by=0.2)].mean(axis=0)
    assert tint[2] > tint[1] > tint[0]  # blue

    choose(page, ".slab-axis", "0")
    assert painted(rods(page)).mean() < 0.9 * painted(whole).mean()
    choose(page, ".slab-axis", "")
    page.find(".box input").click()
    assert 0.0005 < differing(rods(page), whole) < 0.05
    page.find(".forces input").click()
    red, green, blue = np.moveaxis(rods(page), 2, 0)
    assert np.mean((red > 0.5) & (green < 0.35) & (blue < 0.4)) > 1e-3


def test_plots_tell_values_zoom_and_set_the_time(page, run):
    time, Z = (np.array(column(run / "series.csv", name)) for name in ("time", "Z"))
    graph = page.find('.plot[data-curve="Z"] .graph')
    ActionChains(page.driver).scroll_to_element(graph).move_to_element(graph).perform()
    text = page.wait("return /:/.test(document.querySelector('.plot[data-curve=Z] .values').textContent) && "
                     "document.querySelector('.plot[data-curve=Z] .values').textContent")
    at, value = (float(number) for number in re.fullmatch(r"time ([\d.]+) \S.*: ([\d.]+)", text).groups())
    row = np.argmin(np.abs(time - at))
    assert abs(time[row] - at) < 1e-3 and value == pytest.approx(Z[row], rel=1e-4)

    labels = "return [...document.querySelectorAll('.plot[data-curve=Z] .dygraph-axis-label-x')].map((one) => one.textContent).join()"
    before = page.run(labels)
    ActionChains(page.driver).move_to_element_with_offset(graph, -60, 0).click_and_hold().move_by_offset(90, 0).release().perform()
    assert page.wait(f"{labels} !== arguments[0] && 'zoomed'", before)
    ActionChains(page.driver).double_click(graph).perform()
    page.wait(f"{labels} === arguments[0]", before)
    ActionChains(page.driver).move_to_element(graph).click().perform()
    shown = float(page.find(".time-bar output").text.split()[0])
    assert abs(shown - at) < 0.06 * time[-1]  # the nearest frame of 21


@pytest.mark.parametrize("width", [360, 420])
def test_a_phone_has_nothing_to_scroll_sideways(page, run, width):
    page.open(run / "report/report.html", width=width, height=780)
    assert page.run("return document.documentElement.scrollWidth") == width
    for selector in ("#view canvas", ".time-bar", ".graph", "table"):
        left, right = page.run("const box = document.querySelector(arguments[0]).getBoundingClientRect(); return [box.left, box.right]", selector)
        assert 0 <= left < right <= width, selector
    top = page.run("return document.querySelector('#view canvas').getBoundingClientRect().top")
    assert top < 780  # verdict, numbers and rods on the first screen


def test_shapes_are_those_of_spherocylinders(run, browser, tmp_path):
    """One rod L = 4 across the view: its outline has the sides and the area of a stadium, L = 0 those of a circle."""
    for length in (4.0, 0.0):
        folder = tmp_path / f"{length:g}"
        shutil.copytree(run, folder / "run")
        shutil.rmtree(folder / "run/report")
        only_rod(folder / "run/trajectory.h5", length)
        report(folder)
        browser.open(folder / "run/report/report.html")
        page = bare(browser)
        page.find(".box input").click()
        choose(page, ".colour", "plain")
        page.find("#view canvas").send_keys("y")
        outline = painted(rods(page))
        rows, columns = (np.flatnonzero(outline.any(axis=axis)) for axis in (1, 0))
        high, wide = len(rows), len(columns)  # the axis lies along z
        # Antialiasing may add a pixel at either side.
        assert high == pytest.approx((length + 1.0) * wide, abs=2 * (length + 1.0))
        diameter = wide - 1
        # Of the rod's own length: whether the outermost row of pixels is painted changes from drawing to drawing.
        assert outline.sum() == pytest.approx((np.pi / 4 + length) * diameter**2, rel=0.06)


def only_rod(path, length):
    """Leaves one rod in the middle of the box, along z, in every frame: all are drawn in one place."""
    with h5py.File(path, "r+") as file:
        group = file["particles/rods"]
        group["position/value"][...] = 0.5 * group["box/edges"][()]
        group["orientation/value"][...] = (0.0, 0.0, 1.0)
        group["length/value"][...] = length
        group["diameter/value"][...] = 1.0


def test_positions_and_axes_are_right_to_their_last_digit(run):
    """Unpacked as the page does it: within half a digit of 16 bits."""
    page = (run / "report/report.html").read_text()
    group = h5py.File(run / "trajectory.h5")["particles/rods"]
    ids, centre, axis = (group[f"{name}/value"][()] for name in ("id", "position", "orientation"))
    order = np.argsort(ids, axis=1)[:, :, None]
    centre, axis = (np.take_along_axis(values, order, axis=1) for values in (centre, axis))
    low, span = (np.array(re.search(rf'"{name}": (\[[^\]]*\])', page)[1].strip("[]").split(","), float) for name in ("low", "span"))
    for k, name in enumerate("xyz"):
        shown = low[k] + span[k] * packed(page, f"rods-{name}") / 65535
        assert np.abs(shown - centre[:, :, k].ravel()).max() < 0.51 * span[k] / 65535 + 1e-6
    a, b = (2.0 * packed(page, f"rods-axis_{name}") / 65535 - 1.0 for name in "ab")
    z = 1.0 - np.abs(a) - np.abs(b)
    fold = np.maximum(-z, 0.0)
    n = np.stack((a - np.copysign(fold, a), b - np.copysign(fold, b), z), axis=1)
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    assert np.abs(n - axis.reshape(-1, 3)).max() < 1e-4


def packed(page, element):
    planes = zlib.decompress(base64.b64decode(re.search(f'id="{element}">([^<]*)<', page)[1]))
    return np.frombuffer(planes, np.uint8).reshape(2, -1).T.copy().view(np.uint16).ravel().astype(float)


def test_a_limit_leaves_frames_out_and_says_so(run, tmp_path):
    shutil.copytree(run, tmp_path / "run")
    assert "holds" not in report(tmp_path)
    long = h5py.File(tmp_path / "run/trajectory.h5", "r+")
    group = long["particles/rods"]
    for name in ("id", "position", "orientation", "image", "length", "diameter", "stress_collision"):
        values = np.tile(group[f"{name}/value"][()], (1, 10) + (1,) * (group[f"{name}/value"].ndim - 2))
        if name == "id":
            values = np.tile(np.arange(values.shape[1]), (len(values), 1)).astype(values.dtype)
        del group[f"{name}/value"]
        group[f"{name}/value"] = values
    long.close()
    said = report(tmp_path, "--megabytes", "0.1")
    shown, of = map(int, re.search(r"holds (\d+) of the (\d+) frames", said).groups())
    assert of == 21 and 2 <= shown < 21
    page = (tmp_path / "run/report/report.html").read_text()
    assert f"holds {shown} of the 21 frames" in page and len(packed(page, "rods-x")) == shown * 500


def test_without_webgl_the_still_is_seen(run, tmp_path):
    browser = Browser(tmp_path, *browsers.NO_WEBGL)
    try:
        browser.open(run / "report/report.html")
        assert browser.find("#view .stage img").is_displayed()
        assert "no WebGL 2" in browser.find("#view .note").text
        assert browser.find(".plot .graph").is_displayed()
        assert browser.errors() == []
    finally:
        browser.close()


def test_a_colony_has_a_page_of_its_own(browser, tmp_path):
    write_scene(tmp_path, COLONY)
    finish(tmp_path)
    report(tmp_path)
    folder = tmp_path / "run"
    text = (folder / "report/report.html").read_text()
    assert "ompressibility" not in text.split("<details")[0] and "time_unit" not in text.split("<pre>")[0]
    assert not (folder / "report/Z.png").exists()
    browser.open(folder / "report/report.html")
    page = bare(browser)
    titles = page.run("return [...document.querySelectorAll('.plots:not(details *) h3')].map((one) => one.textContent)")
    assert titles == ["Cells", "Radius of the colony", "Pressure inside the colony", "Lengths of the cells", "Ages of the cells"]
    cells = column(folder / "series.csv", "N")[-1]
    assert page.find(".tile dd").text.split()[0] == f"{cells:.0f}"
    assert page.run("return [...document.querySelectorAll('.tile dt')].map((one) => one.textContent)")[1] == "doubling time"
    pictures = {}
    for key in ("family", "generation", "age", "own_length", "pressure"):
        choose(page, ".colour", key)
        pictures[key] = rods(page)
    for key, picture in pictures.items():
        assert painted(picture).mean() > 0.01
        assert key == "family" or differing(picture, pictures["family"]) > 0.01, key
    assert page.errors() == []

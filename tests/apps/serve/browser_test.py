"""browser_test.py URL PID FOLDER: looks at a served viewer in headless Chromium."""
import os
import re
import shutil
import signal
import sys
import time
import urllib.request

from selenium import webdriver
from selenium.webdriver import ActionChains, Keys
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

url, pid, folder = sys.argv[1].strip(), int(sys.argv[2]), sys.argv[3]
site, token = url.split("?token=")
port = int(re.search(r":(\d+)/", site).group(1))


def browser(*more):
    options = webdriver.ChromeOptions()
    for argument in ("headless=new", "no-sandbox", "disable-gpu", "disable-dev-shm-usage",
                     "window-size=1300,800", "user-data-dir=" + folder,
                     "host-resolver-rules=MAP evil.example 127.0.0.1") + more:
        options.add_argument("--" + argument)
    return webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)


def ask(path):
    return urllib.request.urlopen(urllib.request.Request(
        site + path, headers={"Authorization": "Bearer " + token}))


def heading():
    return float(re.search(r"heading_deg = (\S+)", ask("camera").read().decode()).group(1))


def cpu_s():
    with open(f"/proc/{pid}/stat") as stat:
        fields = stat.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def frames_a_second(seconds):
    """As another client sees them."""
    pictures, begin = 0, time.time()
    with ask("stream") as stream:
        rest = b""
        while time.time() - begin < seconds:
            rest += stream.read1(65536)
            pictures += rest.count(b"Content-Length")
            rest = rest[-13:]
    return pictures / (time.time() - begin)


def wait_until(script, what, seconds=30):
    deadline = time.time() + seconds
    while not chromium.execute_script("return " + script):
        assert time.time() < deadline, (what, chromium.execute_script("return document.body.innerText"))
        time.sleep(0.1)


def silence_server():
    os.kill(pid, signal.SIGSTOP)
    try:
        begin = time.time()
        wait_until("lost.textContent", "no word of the lost connection", 5)
        print(f"the page noticed after {time.time() - begin:.1f} s")
        assert time.time() - begin < 3.5  # 3, and what a busy machine adds
        assert "connection lost" in chromium.find_element(By.ID, "lost").text
    finally:
        os.kill(pid, signal.SIGCONT)


def changed(before):
    """Whether the page looks otherwise; a sea moves, so sizes of PNG files tell."""
    return len(chromium.get_screenshot_as_png()) != len(before)


chromium = browser()
try:
    # The token leaves the URL, stays in a cookie that no script reads, and is enough for a reload.
    chromium.get(url)
    wait_until("picture.width === 1280 && picture.height === 720", "no picture")
    assert chromium.current_url == site, chromium.current_url
    assert chromium.execute_script("return document.cookie") == ""
    assert chromium.get_cookie(f"swell_token_{port}")["httpOnly"]
    chromium.refresh()
    wait_until("picture.width === 1280 && picture.height === 720", "no picture after a reload")

    # A key changes the picture: the panel comes.
    without_panel = chromium.get_screenshot_as_png()
    wait_until("!panelIsOpen", "the panel is open at the start")
    ActionChains(chromium).send_keys(Keys.F2).perform()
    wait_until("panelIsOpen", "no panel")
    assert changed(without_panel)
    ActionChains(chromium).send_keys(Keys.F2).perform()
    wait_until("!panelIsOpen", "the panel stays")

    # Dragging turns the camera.
    before = heading()
    image = chromium.find_element(By.ID, "picture")
    ActionChains(chromium).move_to_element(image).click_and_hold().move_by_offset(
        150, 0).release().perform()
    time.sleep(1.0)
    assert abs(heading() - before) > 1.0, (before, heading())

    print(f"{frames_a_second(4.0):.0f} frames/s for a second client at 1280x720")

    # A server that is silent is noticed within 3 s, and the page comes back by itself.
    silence_server()
    wait_until("!lost.textContent", "it does not come back")

    # A name that was pointed to this machine gets nothing, whatever it knows.
    chromium.get(f"http://evil.example:{port}/?token={token}")
    text = chromium.find_element(By.TAG_NAME, "body").text
    assert "--serve-host" in text and "evil.example" in text, text
    # A page there reaches neither the scene nor a seat, though the browser has the cookie.
    fetched = chromium.execute_async_script("""
        const done = arguments[arguments.length - 1];
        Promise.allSettled([fetch("/scene"), fetch("/input", {method: "POST", body: "[]"}),
                            fetch(arguments[0] + "scene", {credentials: "include"})])
            .then(all => done(all.map(one => one.value ? one.value.status : 0)));""", site)
    assert not {200, 204} & set(fetched), fetched
    # Such a page's policy forbids images; one from elsewhere asks as any page does.
    chromium.get("data:text/html,<title>elsewhere</title>" + "".join(
        f"<img src='{site}stream?{i}'><img src='{site}stream?token={token}'>" for i in range(4)))
    time.sleep(1.0)
    sizes = chromium.execute_script("return [...document.images].map(one => one.naturalWidth)")
    assert sizes == [0] * 8, sizes
    with ask("stream") as stream:  # a seat is free
        assert stream.status == 200

    # On a phone the page fits, with the panel at a size that can be read.
    chromium.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True})
    chromium.get(site)
    wait_until("picture.width === 1280", "no picture on a phone")
    fits = "document.documentElement.scrollWidth <= 390 && innerWidth === 390"
    wait_until(fits + " && picture.getBoundingClientRect().width <= 390", "it does not fit")
    chromium.find_element(By.ID, "panel").click()
    wait_until("panelIsOpen && picture.getBoundingClientRect().width === 1280", "a tiny panel")
    wait_until(fits, "it does not fit with the panel")
    if len(sys.argv) > 4:
        time.sleep(1.0)
        chromium.save_screenshot(sys.argv[4] + "/phone_panel.png")
    chromium.find_element(By.ID, "panel").click()
    wait_until("!panelIsOpen && picture.getBoundingClientRect().width <= 390", "the panel stays")
    if len(sys.argv) > 4:
        time.sleep(1.0)
        chromium.save_screenshot(sys.argv[4] + "/phone.png")

    # Started anew, a server has another token: as if the cookie were gone.
    chromium.delete_all_cookies()
    silence_server()
    wait_until("lost.textContent.includes('another token')", "no word of the other token")
finally:
    chromium.quit()

# A closed tab leaves no work behind.
time.sleep(2.0)
begin = cpu_s()
time.sleep(2.0)
assert cpu_s() - begin < 0.2, cpu_s() - begin

"""browser_test.py URL PID FOLDER: looks at a served viewer in headless Chromium."""
import os
import re
import sys
import time
import urllib.request

from selenium import webdriver
from selenium.webdriver import ActionChains, Keys
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

url, pid, folder = sys.argv[1].strip(), int(sys.argv[2]), sys.argv[3]


def browser():
    options = webdriver.ChromeOptions()
    for argument in ("headless=new", "no-sandbox", "disable-gpu", "disable-dev-shm-usage",
                     "window-size=1300,800", "user-data-dir=" + folder):
        options.add_argument("--" + argument)
    return webdriver.Chrome(service=Service(), options=options)


def heading():
    text = urllib.request.urlopen(url + "camera").read().decode()
    return float(re.search(r"heading_deg = (\S+)", text).group(1))


def cpu_s():
    with open(f"/proc/{pid}/stat") as stat:
        fields = stat.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def frames_a_second(seconds):
    """As another client sees them."""
    pictures, begin = 0, time.time()
    with urllib.request.urlopen(url + "stream") as stream:
        rest = b""
        while time.time() - begin < seconds:
            rest += stream.read1(65536)
            pictures += rest.count(b"Content-Length")
            rest = rest[-13:]
    return pictures / (time.time() - begin)


chromium = browser()
try:
    chromium.get(url)
    deadline = time.time() + 30
    size = [0, 0]
    while size != [1280, 720] and time.time() < deadline:
        time.sleep(0.2)
        size = chromium.execute_script("return [picture.naturalWidth, picture.naturalHeight]")
    assert size == [1280, 720], size

    # A key changes the picture: the panel goes.
    with_panel = chromium.get_screenshot_as_png()
    ActionChains(chromium).send_keys(Keys.F2).perform()
    time.sleep(1.0)
    assert len(chromium.get_screenshot_as_png()) != len(with_panel)

    # Dragging turns the camera.
    before = heading()
    image = chromium.find_element(By.ID, "picture")
    ActionChains(chromium).move_to_element(image).click_and_hold().move_by_offset(
        150, 0).release().perform()
    time.sleep(1.0)
    assert abs(heading() - before) > 1.0, (before, heading())

    print(f"{frames_a_second(4.0):.0f} frames/s for a second client at 1280x720")
finally:
    chromium.quit()

# A closed tab leaves no work behind.
time.sleep(2.0)
begin = cpu_s()
time.sleep(2.0)
assert cpu_s() - begin < 0.2, cpu_s() - begin

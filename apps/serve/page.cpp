#include "apps/serve/page.h"

#include <string_view>

namespace swell::serve {
namespace {

constexpr std::string_view kNonce = "NONCE";

// The stream is read by the script and not by an <img>, which tells nobody when its server is gone.
constexpr std::string_view kPage = R"html(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>swell</title>
<link rel="icon" href="data:,">
<style nonce="NONCE">
  html, body { margin: 0; height: 100%; background: #101418; color: #c8d0d8; font: 14px sans-serif; }
  body { display: flex; flex-direction: column; height: 100dvh; overflow: hidden; }
  #view { position: relative; flex: 1; min-height: 0; overflow: hidden; }
  #picture { position: absolute; inset: 0; margin: auto; max-width: 100%; max-height: 100%;
             touch-action: none; outline: none; }
  .near #picture { inset: 0 auto auto 0; margin: 0; max-width: none; max-height: none; }
  #lost { position: absolute; top: 0; left: 0; right: 0; padding: 8px; text-align: center;
          background: #702020; color: white; }
  #lost:empty { display: none; }
  #line { display: flex; flex-wrap: wrap; gap: 4px 12px; align-items: center; justify-content: center;
          padding: 4px 8px; }
  #line a, #line button { color: #8fc7ff; }
  @media (pointer: coarse) { #keys, .typed { display: none; } }
  .near #view { overflow: auto; }
  #line button { font: inherit; background: #1c242c; border: 1px solid #405060; padding: 2px 8px; }
</style>
</head>
<body>
<div id="view"><canvas id="picture" tabindex="0" width="16" height="9" role="img" aria-label="the sea"></canvas><div id="lost" role="alert"></div></div>
<div id="line"><span id="says"><span class="typed">W A S D fly, </span>drag to look</span>
<button id="panel">panel</button><button id="keys">keys</button>
<a id="camera" href="#">camera as TOML</a><a href="scene" download="swell.toml">scene</a><a href="picture.jpg" download="swell.jpg">picture</a></div>
<script nonce="NONCE">
"use strict";
const picture = document.getElementById("picture"), says = document.getElementById("says");
const lost = document.getElementById("lost"), paper = picture.getContext("2d");
// The cookie has the token from here on: it shall not stand in the history or on a screenshot.
if (location.search) history.replaceState(null, "", location.pathname);

// ---- the stream ----

// A phone shows the panel at its own size, and of the picture what is behind it.
let panelIsOpen = false;
function fit() {
  document.body.classList.toggle("near", panelIsOpen && innerWidth < 0.8 * picture.width);
}
window.addEventListener("resize", fit);

// The newest picture; what comes while one is decoded replaces the one that waits.
let next = null, drawing = false;
async function show(jpeg) {
  next = jpeg;
  if (drawing) return;
  drawing = true;
  while (next) {
    const taken = next;
    next = null;
    try {
      const bitmap = await createImageBitmap(taken);
      if (picture.width !== bitmap.width || picture.height !== bitmap.height) {
        picture.width = bitmap.width;
        picture.height = bitmap.height;
      }
      paper.drawImage(bitmap, 0, 0);
      bitmap.close();
      fit();
    } catch (error) { }
  }
  drawing = false;
}

// Cuts a multipart text into its pictures.
function cutter() {
  let rest = new Uint8Array(0), length = -1;
  const ascii = new TextDecoder("latin1");
  return bytes => {
    const all = new Uint8Array(rest.length + bytes.length);
    all.set(rest);
    all.set(bytes, rest.length);
    rest = all;
    for (;;) {
      if (length < 0) {
        const head = ascii.decode(rest.subarray(0, 1024)), end = head.indexOf("\r\n\r\n");
        const found = /Content-Length: (\d+)/.exec(head.slice(0, Math.max(end, 0)));
        if (!found) return;
        length = Number(found[1]);
        panelIsOpen = head.slice(0, end).includes("X-Swell-Panel: open");
        rest = rest.subarray(end + 4);
      }
      if (rest.length < length) return;
      show(new Blob([rest.subarray(0, length)], {type: "image/jpeg"}));
      rest = rest.subarray(length);
      length = -1;
    }
  };
}

// The server sends something every second.
const silence_ms = 2200, again_ms = 1000;
async function look() {
  const broken = new AbortController();
  let heard = performance.now();
  const watch = setInterval(() => {
    if (performance.now() - heard > silence_ms) broken.abort();
  }, 250);
  let why = "connection lost, trying again";
  try {
    const answer = await fetch("stream", {signal: broken.signal, cache: "no-store"});
    if (answer.ok) {
      const reader = answer.body.getReader(), cut = cutter();
      for (;;) {
        const {done, value} = await reader.read();
        if (done) break;
        heard = performance.now();
        lost.textContent = "";
        cut(value);
      }
    } else if (answer.status === 403) {
      why = "the server was started anew and has another token: open the URL that it printed";
    } else {
      why = await answer.text();
    }
  } catch (error) { }
  clearInterval(watch);
  broken.abort();
  lost.textContent = why;
  setTimeout(look, again_ms);
}

// ---- keyboard and mouse ----

let waiting = [], sending = false;
function send(event) {
  if (lost.textContent) return;
  waiting.push(event);
  if (!sending) flush();
}

// One message at a time, so that events keep their order; what happens meanwhile goes together.
async function flush() {
  sending = true;
  while (waiting.length > 0) {
    const events = waiting.splice(0, 256);
    try {
      const answer = await fetch("input", {method: "POST", body: JSON.stringify(events),
                                           signal: AbortSignal.timeout(5000)});
      if (!answer.ok) says.textContent = await answer.text();
    } catch (error) {
      waiting = [];
    }
  }
  sending = false;
}

function press(code) {
  for (const down of [true, false]) send({type: "key", code: code, down: down, repeat: false});
  picture.focus();
}
document.getElementById("panel").addEventListener("click", () => press("F2"));
document.getElementById("keys").addEventListener("click", () => press("F1"));

function place(event) {
  const box = picture.getBoundingClientRect();
  const scale = picture.width / Math.max(box.width, 1);
  return {x: (event.clientX - box.left) * scale, y: (event.clientY - box.top) * scale};
}

let before = null;  // the last place of the pointer
picture.addEventListener("pointermove", event => {
  const at = place(event);
  const move = {type: "move", x: at.x, y: at.y,
                dx: before ? at.x - before.x : 0, dy: before ? at.y - before.y : 0};
  before = at;
  const last = waiting[waiting.length - 1];
  if (last && last.type === "move") { move.dx += last.dx; move.dy += last.dy; waiting.pop(); }
  send(move);
});
for (const [name, down] of [["pointerdown", true], ["pointerup", false], ["pointercancel", false]])
  picture.addEventListener(name, event => {
    if (down) { picture.setPointerCapture(event.pointerId); picture.focus(); }
    const at = place(event);
    send({type: "button", button: Math.max(event.button, 0), down: down, x: at.x, y: at.y});
    event.preventDefault();
  });
picture.addEventListener("contextmenu", event => event.preventDefault());
picture.addEventListener("auxclick", event => event.preventDefault());
picture.addEventListener("pointerleave", () => { before = null; send({type: "leave"}); });
picture.addEventListener("wheel", event => {
  send({type: "wheel", y: -Math.sign(event.deltaY)});
  event.preventDefault();
}, {passive: false});

const ours = /^(Key[ADEHPQRSW]|Digit[0-9]|Space|Shift(Left|Right)|Period|F[1-4]|Arrow(Left|Right)|Backspace|Delete|Enter|Tab)$/;
for (const [name, down] of [["keydown", true], ["keyup", false]])
  window.addEventListener(name, event => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target.closest && event.target.closest("#line")) return;
    if (down && event.code === "KeyC") return void copyCamera();
    if (down && event.key.length === 1) send({type: "text", text: event.key});
    if (!ours.test(event.code)) return;
    send({type: "key", code: event.code, down: down, repeat: event.repeat});
    event.preventDefault();
  });
window.addEventListener("blur", () => send({type: "leave"}));

async function copyCamera() {
  const text = await (await fetch("camera")).text();
  try {
    await navigator.clipboard.writeText(text);
    says.textContent = "copied the camera as TOML";
  } catch (error) {
    window.prompt("The camera as TOML", text);
  }
}
document.getElementById("camera").addEventListener("click", event => {
  event.preventDefault();
  copyCamera();
});

look();
picture.focus();
</script>
</body>
</html>
)html";

}  // namespace

std::string page_html(const std::string& nonce) {
  std::string page(kPage);
  for (std::size_t at = page.find(kNonce); at != std::string::npos; at = page.find(kNonce, at))
    page.replace(at, kNonce.size(), nonce);
  return page;
}

}  // namespace swell::serve

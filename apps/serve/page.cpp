#include "apps/serve/page.h"

namespace swell::serve {

std::string_view page_html() {
  return R"html(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>swell</title>
<style>
  html, body { margin: 0; height: 100%; background: #101418; color: #c8d0d8; font: 14px sans-serif; }
  body { display: flex; flex-direction: column; align-items: center; justify-content: center; }
  #picture { max-width: 100vw; max-height: calc(100vh - 28px); touch-action: none; outline: none; }
  #line { height: 20px; padding: 4px; white-space: nowrap; }
  #line a { color: #8fc7ff; margin-left: 1em; }
</style>
</head>
<body>
<img id="picture" tabindex="0" draggable="false" alt="the sea">
<div id="line"><span id="says">W A S D fly, drag to look, F1 help</span>
<a id="camera" href="#">camera as TOML</a><a id="scene" href="#" download="swell.toml">scene</a><a id="save" href="#" download="swell.jpg">picture</a></div>
<script>
"use strict";
const picture = document.getElementById("picture"), says = document.getElementById("says");
const query = location.search;
let waiting = [], sending = false;

function send(event) {
  waiting.push(event);
  if (!sending) flush();
}

// One message at a time, so that events keep their order; what happens meanwhile goes together.
async function flush() {
  sending = true;
  while (waiting.length > 0) {
    const events = waiting.splice(0, 256);
    try {
      const answer = await fetch("input" + query, {method: "POST", body: JSON.stringify(events)});
      if (!answer.ok) says.textContent = await answer.text();
    } catch (error) {
      says.textContent = "no connection";
      waiting = [];
    }
  }
  sending = false;
}

function place(event) {
  const box = picture.getBoundingClientRect();
  const scale = picture.naturalWidth / Math.max(box.width, 1);
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
    if (down && event.code === "KeyC") return void copyCamera();
    if (down && event.key.length === 1) send({type: "text", text: event.key});
    if (!ours.test(event.code)) return;
    send({type: "key", code: event.code, down: down, repeat: event.repeat});
    event.preventDefault();
  });
window.addEventListener("blur", () => send({type: "leave"}));

async function copyCamera() {
  const text = await (await fetch("camera" + query)).text();
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
document.getElementById("scene").href = "scene" + query;
document.getElementById("save").href = "picture.jpg" + query;

function look() {
  picture.src = "stream" + query + (query ? "&" : "?") + "at=" + Date.now();
}
picture.addEventListener("error", async () => {
  try {
    const answer = await fetch("stream/state" + query);
    says.textContent = await answer.text();
  } catch (error) {
    says.textContent = "no connection";
  }
  setTimeout(look, 1000);
});
look();
picture.focus();
</script>
</body>
</html>
)html";
}

}  // namespace swell::serve

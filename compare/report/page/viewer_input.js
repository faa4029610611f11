"use strict";
// Pointers and keys of the viewer: when they do what. acts: what can be done, from viewer.js.
(function (viewer) {
  // The place of a pointer in its panel, parts of the width from the left and of the height from below.
  function placeOf(event) {
    const box = event.target.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
  }

  function listenToPanels(holder, acts) {
    const on = (name, act, options) => holder.addEventListener(name, (event) => {
      if (event.target.localName === "canvas") act(event);
    }, options);
    on("dblclick", (event) => acts.zoomAt(2, placeOf(event)));
    on("wheel", (event) => {
      if (!event.ctrlKey && !event.shiftKey) return;  // the page's own
      event.preventDefault();
      acts.zoomAt(event.deltaY < 0 ? 1.25 : 0.8, placeOf(event));
    }, {passive: false});
    on("pointermove", (event) => {
      if (!event.buttons) return;
      const box = event.target.getBoundingClientRect();
      acts.drag([event.movementX / box.width, -event.movementY / box.height], [event.movementX, event.movementY]);
    });
  }

  function onKey(event, acts) {
    if (event.altKey || event.ctrlKey || event.metaKey || event.target.localName === "select") return;
    const steps = {ArrowLeft: -1, ArrowRight: 1, ArrowDown: -1, ArrowUp: 1, PageDown: -10, PageUp: 10,
      Home: -acts.last, End: acts.last};
    const turns = {ArrowLeft: [-10, 0], ArrowRight: [10, 0], ArrowUp: [0, 10], ArrowDown: [0, -10]};
    if (acts.inSpace() && event.shiftKey && event.key in turns) acts.turn(...turns[event.key]);
    else if (event.key in steps) acts.step(steps[event.key]);
    else if (event.key === "+" || event.key === "=") acts.zoomMiddle(1.5);
    else if (event.key === "-") acts.zoomMiddle(1 / 1.5);
    else if (event.key === "0") acts.zoomOut();
    else return;
    event.preventDefault();
  }

  // Space plays and pauses wherever the focus is, but where it means something itself.
  function onSpace(event, acts) {
    if (event.key !== " " || event.altKey || event.ctrlKey || event.metaKey || event.defaultPrevented) return;
    const own = "button, select, textarea, summary, [contenteditable], input:not(.viewer-slider)";
    if (event.target.closest && event.target.closest(own)) return;
    event.preventDefault();
    acts.toggle();
  }

  viewer.listen = function (root, panels, acts) {
    listenToPanels(panels, acts);
    root.addEventListener("keydown", (event) => onKey(event, acts));
    document.addEventListener("keydown", (event) => onSpace(event, acts));
  };
})(surgeViewer);

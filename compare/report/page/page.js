"use strict";
// A link to a part that is folded away opens it.
(function () {
  function open() {
    const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!target) return;
    const inside = target.querySelector(":scope > details.fold");
    for (let at = inside || target; at; at = at.parentElement) if (at.localName === "details") at.open = true;
    target.scrollIntoView();
  }
  window.addEventListener("hashchange", open);
  if (location.hash) open();
})();

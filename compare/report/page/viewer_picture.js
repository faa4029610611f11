// A frame as a PNG: what the panels show, with their names, the time and the scale of the colours.
(function (viewer) {
  const gap = 24;
  const line = 22;

  function drawScale(context, x, y, palette, quantity) {
    palette.forEach((colour, i) => {
      context.fillStyle = colour;
      context.fillRect(x + (160 * i) / palette.length, y, 160 / palette.length + 1, 12);
    });
    context.fillStyle = "#1c1c1c";
    context.fillText("0", x - 14, y + 11);
    context.fillText("1  " + quantity, x + 166, y + 11);
  }

  // panels: {canvas, label}; words: {title, time, quantity}. Returns a canvas.
  viewer.composePicture = function (panels, words, palette) {
    const width = panels.reduce((sum, panel) => sum + panel.canvas.width + gap, gap);
    const height = panels.reduce((most, panel) => Math.max(most, panel.canvas.height), 0);
    const picture = document.createElement("canvas");
    picture.width = Math.max(width, 460);
    picture.height = height + 5 * line + gap;
    const context = picture.getContext("2d");
    context.fillStyle = "#fff";
    context.fillRect(0, 0, picture.width, picture.height);
    context.fillStyle = "#1c1c1c";
    context.font = "600 16px sans-serif";
    context.fillText(words.title, gap, line + 4);
    context.font = "14px sans-serif";
    context.fillText(words.time, gap, 2 * line + 4);
    let x = gap;
    for (const panel of panels) {
      context.fillStyle = "#1c1c1c";
      context.fillText(panel.label, x, 3 * line + 4);
      context.drawImage(panel.canvas, x, 3 * line + 14 + height - panel.canvas.height);
      x += panel.canvas.width + gap;
    }
    drawScale(context, gap + 14, height + 3 * line + 26, palette, words.quantity);
    return picture;
  };

  viewer.savePicture = function (picture, name) {
    picture.toBlob((blob) => {
      const link = document.createElement("a");
      link.href = URL.createObjectURL(blob);
      link.download = name;
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    }, "image/png");
  };
})(surgeViewer);

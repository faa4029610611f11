"""The viewer of a study in three dimensions: water in space, to be turned, and what is left without WebGL."""

import base64
import struct
import zlib

import chromium
from made_report import Page, write_space_report


def pixels_of(address):
    """Rows of (red, green, blue, opacity) of a PNG as a data: address, of eight bits a channel."""
    data = base64.b64decode(address.split(",", 1)[1])
    at, packed, width, height = 8, b"", 0, 0
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            assert (depth, colour) == (8, 6)
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    raw, rows, before = zlib.decompress(packed), [], bytearray(4 * width)
    for y in range(height):
        kind, row = raw[y * (4 * width + 1)], bytearray(raw[y * (4 * width + 1) + 1:(y + 1) * (4 * width + 1)])
        for i in range(4 * width):
            left, up, corner = row[i - 4] if i > 3 else 0, before[i], before[i - 4] if i > 3 else 0
            if kind == 4:  # Paeth
                guess = left + up - corner
                away = (abs(guess - left), abs(guess - up), abs(guess - corner))
                row[i] = row[i] + (left, up, corner)[away.index(min(away))] & 255
            else:
                row[i] = row[i] + (0, left, up, (left + up) // 2)[kind] & 255
        rows.append([tuple(row[i:i + 4]) for i in range(0, 4 * width, 4)])
        before = row
    return rows


class InSpace(Page):
    write = staticmethod(write_space_report)

    def panels(self):
        return self.browser.js("[...document.querySelectorAll('.viewer-panel canvas')].map(c => c.toDataURL())")

    def choose(self, name, value):
        self.browser.js(f"{{const s = document.querySelector('.viewer-{name}'); s.value = '{value}';"
                        "s.dispatchEvent(new Event('change'))}")


class Space(InSpace):
    flags = chromium.SOFTWARE_WEBGL

    def setUp(self):
        super().setUp()
        self.assertTrue(self.browser.js("!!document.createElement('canvas').getContext('webgl')"),
                        "this Chromium draws no WebGL in software")

    def test_the_water_is_there_in_the_colours_of_the_scale(self):
        self.assertFalse(self.browser.js("document.querySelector('.viewer-space').hidden"))
        self.assertEqual(self.browser.js("document.querySelector('.viewer-field').value"), "speed")
        self.choose("mode", "two")
        for panel in self.panels():
            seen = [pixel for row in pixels_of(panel) for pixel in row]
            water = [1 for r, g, b, _ in seen if max(r, g, b) - min(r, g, b) > 30]  # the rest is grey and white
            # The cube of water is a fifth as wide as the tank and a third as high.
            self.assertGreater(len(water), 0.01 * len(seen))
            self.assertLess(len(water), 0.4 * len(seen))

    def test_turning_by_keys_buttons_and_pointer(self):
        start = self.panels()
        self.browser.js("document.querySelector('.viewer-slider').focus()")
        self.browser.call("Input.dispatchKeyEvent", type="keyDown", key="ArrowRight", code="ArrowRight", modifiers=8,
                          windowsVirtualKeyCode=39)
        turned = self.panels()
        self.assertNotEqual(start, turned)
        self.assertEqual(self.browser.js("document.querySelector('.viewer-slider').value"), "0")
        self.browser.js("document.querySelector('.viewer-turn button').click()")
        clicked = self.panels()
        self.assertNotEqual(turned, clicked)
        self.browser.js("{const c = document.querySelector('.viewer-panel canvas');"
                        "c.dispatchEvent(new PointerEvent('pointermove', {bubbles: true, buttons: 1, movementX: 40, movementY: 9}))}")
        self.assertNotEqual(clicked, self.panels())
        self.browser.js("document.querySelector('.viewer-whole').click()")
        self.assertEqual(start, self.panels())

    def test_frames_colours_zoom_and_the_other_run_change_the_picture(self):
        seen = [self.panels()]
        for act in ("{const s = document.querySelector('.viewer-slider'); s.value = 8; s.dispatchEvent(new Event('input'))}",
                    "document.querySelector('.viewer-closer').click()",
                    "document.querySelector('.viewer-surface').click()"):
            self.browser.js(act)
            seen.append(self.panels())
        self.choose("field", "pressure")
        seen.append(self.panels())
        self.choose("mode", "over")
        seen.append(self.panels())
        for before, after in zip(seen, seen[1:]):
            self.assertNotEqual(before, after)
        label = self.browser.js("document.querySelector('.viewer-panel canvas').getAttribute('aria-label')")
        self.assertIn("in space at", label)

    def test_the_slice_is_one_layer_of_the_whole(self):
        inside, whole, middle = self.browser.js(
            "{const r = surgeViewer.runs[0]; [Array.from(r.water.z || []), r.whole.starts[1], r.water.starts[1]]}")
        self.assertEqual(whole, 1000)  # ten particles to each side of the cube
        self.assertEqual(middle, 200)  # the two layers beside the plane in the middle
        self.assertEqual(inside, [])
        # Of a mesh one layer: the area of the cube.
        area = self.browser.js("{const w = surgeViewer.runs[1].water; let sum = 0;"
                               " for (let i = 0; i < w.starts[1]; ++i) sum += w.fraction[i] / 255 * (2 * w.half) ** 2; sum}")
        self.assertAlmostEqual(area, 1.0, delta=0.02)

    def test_the_surface_of_the_mesh_holds_the_water(self):
        volume = self.browser.js(
            "{const w = surgeViewer.runs[1].whole, s = surgeViewer.surfaceNets(w.grid, 0, w.half, 'speed'); let sum = 0;"
            "const p = (t) => [0, 1, 2].map((d) => s.place[3 * t + d]);"
            "for (let t = 0; t < s.triangles.length; t += 3) { const [a, b, c] = [0, 1, 2].map((k) => p(s.triangles[t + k]));"
            "sum += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6; }"
            "sum}")
        self.assertAlmostEqual(volume, 1.0, delta=0.05)

    def test_a_frame_becomes_a_picture(self):
        wide = self.browser.js("surgeViewer.picture().width")
        self.assertGreater(wide, 400)

    def test_a_narrow_window_shows_it_too(self):
        self.browser.width(400)
        self.open(self.page.as_uri())
        page, inside = self.browser.js("[document.documentElement.scrollWidth, document.documentElement.clientWidth]")
        self.assertLessEqual(page, inside)
        self.assertEqual(len(set(self.panels())), 2)


class Blind(InSpace):
    flags = ("--disable-3d-apis",)

    def test_without_webgl_the_slice_is_shown_and_it_is_said_why(self):
        state = self.browser.js("[document.querySelector('.viewer-dimension').value,"
                                " document.querySelector('.viewer-dimension').disabled,"
                                " document.querySelector('.viewer-flat').hidden, document.querySelector('.viewer-turn').hidden]")
        self.assertEqual(state, ["slice", True, False, True])
        self.assertEqual(len(set(self.panels())), 2)

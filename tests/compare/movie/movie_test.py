"""surge-compare movie: films of a run and of a study. Usage: movie_test.py BUILD_FOLDER; 77 without ffmpeg."""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[3]
DEJAVU = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
BIN = Path(sys.argv.pop(1)).resolve() / "bin"


def call(*words, cwd=SOURCE):
    return subprocess.run([str(word) for word in words], cwd=cwd, text=True, capture_output=True, check=False)


def probe(file):
    """Codec, size and number of pictures of a film, as another program counts them."""
    done = call("ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-of", "json", "-show_entries",
                "stream=codec_name,width,height,nb_read_frames,avg_frame_rate", file)
    return json.loads(done.stdout)["streams"][0]


class Movie(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        for method in ("mps", "sph"):
            done = call(BIN / "surge-particle", "run", "particle/cases/square_column_obstacle.toml", "--out",
                        cls.folder / "runs" / method, "--set", f"method.name={method}", "--set",
                        "method.preset=paper", "--set", "resolution.spacing=0.0145", "--set", "time.end=0.1")
            assert done.returncode == 0, done.stderr
        cls.run_ = cls.folder / "runs/mps"

    def movie(self, *words):
        return call(BIN / "surge-compare", "movie", *words)

    def test_a_run_becomes_a_film_of_the_length_that_is_asked_for(self):
        out = self.folder / "run.mp4"
        done = self.movie(self.run_, "--out", out, "--speed", "0.1", "--pictures", "10", "--width", "320")
        self.assertEqual(done.returncode, 0, done.stderr)
        film = probe(out)
        self.assertEqual((film["codec_name"], film["width"], film["avg_frame_rate"]), ("h264", 320, "10/1"))
        self.assertEqual(int(film["nb_read_frames"]), 11)  # 0.1 s at a tenth: one second, both ends
        self.assertFalse(out.with_name("run.mp4.part").exists())

    def test_pictures_change_as_the_water_moves(self):
        out = self.folder / "moves.gif"
        done = self.movie(self.run_, "--out", out, "--speed", "0.1", "--pictures", "5", "--width", "320")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(probe(out)["codec_name"], "gif")
        sums = call("ffmpeg", "-v", "error", "-i", out, "-f", "framemd5", "-").stdout.splitlines()
        hashes = [line.split(",")[-1] for line in sums if not line.startswith("#")]
        self.assertEqual(len(set(hashes)), len(hashes))
        self.assertEqual(len(hashes), 6)

    def study(self):
        study = self.folder / "study.toml"
        text = ('title = "$(touch pwned) `touch pwned` %{text}"\nreference = "sph"\nstrip_height = 0.0435\n'
                "snapshot_times = [0.05]\n")
        for method in ("mps", "sph"):
            text += (f'[[run]]\nname = "{method}"\nprogram = "surge-particle"\n'
                     'case = "particle/cases/square_column_obstacle.toml"\n'
                     f'set = ["method.name={method}", "method.preset=paper", "resolution.spacing=0.0145", "time.end=0.1"]\n')
        study.write_text(text)
        return study

    def test_the_runs_and_the_end_are_chosen(self):
        out, study = self.folder / "chosen.mp4", self.study()
        words = [study, "--runs", self.folder / "runs", "--out", out, "--pictures", "10", "--speed", "0.1",
                 "--width", "640"]
        heights = []
        for show in ("mps", "sph"):  # beside the reference, which is sph: two panels, then one
            done = self.movie(*words, "--show", show, "--end", "0.05")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(int(probe(out)["nb_read_frames"]), 6)
            heights.append(probe(out)["height"])
        self.assertLess(*heights)  # one panel is wider, and so higher
        done = self.movie(*words, "--show", "mps,isph")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1))
        self.assertIn("--show: found \"isph\", expected names out of mps, sph", done.stderr)
        done = self.movie(self.run_, "--out", self.folder / "n.mp4", "--show", "mps")
        self.assertIn("found one run, expected a study", done.stderr)

    def test_greek_letters_are_drawn(self):
        """The scale's words are "1  p/(rho g H)" with a Greek rho, which is about 8 pixels wide."""
        out = self.folder / "words.mp4"
        self.assertEqual(self.movie(self.run_, "--out", out, "--speed", "0.1", "--pictures", "1").returncode, 0)
        width, height = (int(probe(out)[side]) for side in ("width", "height"))
        pixels = subprocess.run(["ffmpeg", "-v", "error", "-i", out, "-frames:v", "1", "-f", "rawvideo", "-pix_fmt",
                                 "gray", "-"], capture_output=True, check=True).stdout
        rows = [pixels[y * width:(y + 1) * width] for y in range(height - 30, height)]
        inked = [x for x in range(216, 400) if any(row[x] < 140 for row in rows)]
        gaps = [b - a for a, b in zip(inked, inked[1:])]
        self.assertGreater(inked[-1] - inked[0], 56 if Path(DEJAVU).is_file() else 70)
        self.assertLess(sorted(gaps)[-2], 8)  # no letter is missing between two

    def test_a_study_shows_its_runs_side_by_side_and_its_texts_are_no_commands(self):
        study = self.study()
        out = self.folder / "a `touch pwned`.mp4"
        done = self.movie(study, "--runs", self.folder / "runs", "--out", out, "--pictures", "2", "--speed", "0.1",
                          "--width", "641")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(probe(out)["width"], 642)  # even, as the encoder wants it
        self.assertFalse(list(SOURCE.glob("pwned")) + list(self.folder.rglob("pwned")))

    def test_what_cannot_be_is_said_in_one_line_and_leaves_no_file(self):
        for out, said in (("film.avi", "expected .mp4 or .gif"), ("nowhere/film.mp4", "no such folder")):
            with self.subTest(out):
                done = self.movie(self.run_, "--out", self.folder / out)
                self.assertEqual(done.returncode, 1)
                self.assertIn(said, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1)
                self.assertFalse((self.folder / out).exists())
        self.assertEqual(self.movie(self.folder / "nothing", "--out", self.folder / "n.mp4").returncode, 1)


if __name__ == "__main__":
    if shutil.which("ffmpeg") is None or shutil.which("ffprobe") is None:
        print("skipped: ffmpeg is not installed")
        sys.exit(77)
    unittest.main()

"""Pictures and animations, decoded by ffmpeg or by hand."""
import struct
import threading
import unittest
import zlib

import numpy as np

import pliant
from support import Case, has_opengl, meeting


def chunks_of(png):
    at = 8
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at : at + 8])
        data = png[at + 8 : at + 8 + length]
        (crc,) = struct.unpack(">I", png[at + 8 + length : at + 12 + length])
        assert crc == zlib.crc32(kind + data)
        yield kind, data
        at += 12 + length


def decoded(data, height, width):
    """Undoes the filter that takes the row above away from each row."""
    rows = np.frombuffer(zlib.decompress(data), np.uint8).reshape(height, 1 + 3 * width)
    assert (rows[:, 0] == 2).all()
    return np.cumsum(rows[:, 1:], axis=0, dtype=np.uint8).reshape(height, width, 3)


class Files(Case):
    def setUp(self):
        self.frames = [np.random.default_rng(seed).integers(0, 256, (5, 7, 3), np.uint8) for seed in range(3)]

    def test_a_picture_is_a_png(self):
        chunks = dict(chunks_of(pliant.Picture(self.frames[0]).png()))
        self.assertEqual(struct.unpack(">IIBBBBB", chunks[b"IHDR"]), (7, 5, 8, 2, 0, 0, 0))
        self.assert_same_bits(decoded(chunks[b"IDAT"], 5, 7), self.frames[0])

    def test_an_animation_is_an_animated_png(self):
        chunks = list(chunks_of(pliant.Animation(self.frames, 25).png()))
        kinds = [kind for kind, _ in chunks]
        self.assertEqual(kinds, [b"IHDR", b"acTL", b"fcTL", b"IDAT", b"fcTL", b"fdAT", b"fcTL", b"fdAT", b"IEND"])
        self.assertEqual(struct.unpack(">II", chunks[1][1]), (3, 0))
        numbers = [struct.unpack(">I", data[:4])[0] for kind, data in chunks if kind in (b"fcTL", b"fdAT")]
        self.assertEqual(numbers, list(range(5)))
        self.assert_shows(chunks, self.frames)

    def assert_shows(self, chunks, frames):
        """Plays an animation: each part replaces what is below it."""
        places = [struct.unpack(">IIIIHH", data[4:24]) for kind, data in chunks if kind == b"fcTL"]
        stored = [data if kind == b"IDAT" else data[4:] for kind, data in chunks if kind in (b"IDAT", b"fdAT")]
        shown = np.zeros_like(frames[0])
        for (width, height, x, y, delay, unit), data, frame in zip(places, stored, frames, strict=True):
            self.assertEqual(delay / unit, 1 / 25)
            shown[y : y + height, x : x + width] = decoded(data, height, width)
            self.assert_same_bits(shown, frame)

    def test_frames_hold_what_has_changed(self):
        second = self.frames[0].copy()
        second[2:4, 3] ^= 255
        frames = [self.frames[0], second, second, self.frames[1]]
        chunks = list(chunks_of(pliant.Animation(frames, 25).png()))
        self.assert_shows(chunks, frames)
        places = [struct.unpack(">IIII", data[4:20]) for kind, data in chunks if kind == b"fcTL"]
        self.assertEqual(places[:3], [(7, 5, 0, 0), (1, 2, 3, 2), (1, 1, 0, 0)])

    def test_what_is_no_picture_is_refused(self):
        self.assert_error(pliant.InputError, ("pixels", "float64", "uint8"), pliant.Picture, np.zeros((4, 4, 3)))
        self.assert_error(pliant.InputError, ("frames", "none", ""), pliant.Animation, [], 25)
        self.assert_error(pliant.InputError, ("frames", "several sizes", ""), pliant.Animation, [self.frames[0], self.frames[0][1:]], 25)
        self.assert_error(pliant.InputError, ("frame_rate", "0.1", ""), pliant.Animation, self.frames, 0.1)
        for rate in (0.2, 1000):
            delay, unit = struct.unpack(">HH", dict(chunks_of(pliant.Animation(self.frames, rate).png()))[b"fcTL"][20:24])
            self.assertAlmostEqual(delay / unit, 1 / rate)


@unittest.skipUnless(has_opengl(), "there is no OpenGL")
class Drawing(Case):
    def setUp(self):
        self.simulation = pliant.Simulation(pliant.Scene(meeting), "cpu")

    def test_a_picture_shows_the_bodies(self):
        picture = self.simulation.render((64, 48))
        self.assertEqual((picture.shape, picture.dtype), ((48, 64, 3), np.uint8))
        spread = picture.astype(int).max(axis=2) - picture.astype(int).min(axis=2)
        colored = spread > 60  # the ground is grey
        self.assertGreater(colored[:, :32].sum(), 50)
        self.assertGreater(colored[:, 32:].sum(), 50)

    def test_a_camera_and_a_colouring_change_it(self):
        usual = self.simulation.render((64, 48))
        self.assert_same_bits(usual, self.simulation.render((64, 48)))
        behind = self.simulation.render((64, 48), camera={"eye": [0, 1, -6]})
        self.assertFalse(np.array_equal(usual, behind))
        self.assertFalse(np.array_equal(usual, self.simulation.render((64, 48), coloring="deformation")))

    def test_simulations_draw_in_turn(self):
        other = pliant.Simulation(pliant.Scene({"body": [{"mesh": "cube:2"}]}), "cpu")
        on_gpu = pliant.Simulation(pliant.Scene(meeting), "gpu")
        first, second, third = (s.render((64, 48)) for s in (self.simulation, other, on_gpu))
        on_gpu.advance(3)
        del other
        self.assert_same_bits(self.simulation.render((64, 48)), first)
        self.assertFalse(np.array_equal(first, second))
        self.assert_same_bits(first, third)
        on_gpu.advance(7)
        self.simulation.advance(10)
        np.testing.assert_allclose(on_gpu.positions, self.simulation.positions, atol=1e-5)

    def test_what_has_drawn_belongs_to_its_thread(self):
        self.simulation.render((64, 48))
        before = self.simulation.positions
        told = []

        def use(call):
            try:
                call()
            except pliant.Error as error:
                told.append(error)

        calls = (lambda: self.simulation.set_state(positions=before + 1), self.simulation.advance,
                 lambda: self.simulation.render((32, 24)), lambda: self.simulation.restore(self.simulation.save()))
        for call in calls:
            thread = threading.Thread(target=use, args=(call,))
            thread.start()
            thread.join()
        self.assertEqual([type(error) for error in told], 4 * [pliant.DeviceError])
        self.assertIn("another thread", told[0].problem)
        self.assert_same_bits(self.simulation.positions, before)
        self.simulation.advance()

    def test_another_thread_may_drop_it(self):
        drawn = [pliant.Simulation(pliant.Scene(meeting), "cpu")]
        drawn[0].render((64, 48))
        thread = threading.Thread(target=drawn.clear)
        thread.start()
        thread.join()
        self.assert_same_bits(self.simulation.render((64, 48)), self.simulation.render((64, 48)))

    def test_a_picture_follows_changes(self):
        before = self.simulation.render((64, 48))
        self.simulation.set_state(positions=self.simulation.positions + [0, 1, 0])
        self.assertFalse(np.array_equal(before, self.simulation.render((64, 48))))

    def test_show_goes_on(self):
        picture = self.simulation.show(size=(64, 48))
        self.assertEqual(picture._repr_png_(), picture.png())
        animation = self.simulation.show(0.1, size=(64, 48), frame_rate=50)
        self.assertEqual(len(animation.frames), 6)
        self.assertAlmostEqual(self.simulation.time, 0.1, delta=1e-9)
        self.assertIn("data:image/png;base64,", animation._repr_html_())

    def test_what_is_wrong_is_named(self):
        render = self.simulation.render
        self.assert_error(pliant.InputError, ("size", "", "16384"), render, (0, 5))
        self.assert_error(pliant.InputError, ("camera", "has no eye", "eye"), render, camera={"target": [0, 0, 0]})
        self.assert_error(pliant.InputError, ("camera", "roll", "eye"), render, camera={"eye": [1, 0, 0], "roll": 3})
        self.assert_error(pliant.InputError, ("camera", "same point", ""), render, camera={"eye": [1, 0, 0], "target": [1, 0, 0]})
        self.assert_error(pliant.InputError, ("coloring", "'rainbow'", "deformation"), render, coloring="rainbow")


if __name__ == "__main__":
    unittest.main()

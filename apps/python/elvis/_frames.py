"""The pictures of a scene's animation."""

import json

from . import _elvis
from ._picture import Picture
from ._progress import Progress, progress_for


class Frames:
    """Pictures whose colours mean the same in all of them: see Volume.animate. A sequence: each is drawn when it is asked for.

        for number, picture in enumerate(volume.animate(scene)):
            picture.save(f"frame_{number:04}.png")
    """

    def __init__(self, handle: _elvis.Animation, color_only: bool, progress: Progress) -> None:
        self._handle = handle
        self._color_only = color_only
        self._progress = progress

    @property
    def frames_a_second(self) -> float:
        """Of a film, as the scene says."""
        return self._handle.frames_a_second

    @property
    def remarks(self) -> list[str]:
        """Surfaces that none of the pictures drawn so far shows, a sentence each."""
        return json.loads(self._handle.remarks())

    def time_step(self, frame: int) -> int:
        """Which time step a picture shows."""
        return self._handle.time_step(self._place(frame))

    def __len__(self) -> int:
        return self._handle.n_frames

    def __getitem__(self, frame: int) -> Picture:
        place = self._place(frame)
        with progress_for(self._progress) as report:
            return Picture(self._handle.render(place, self._color_only, report))

    def _place(self, frame: int) -> int:
        place = frame + len(self) if frame < 0 else frame
        if not 0 <= place < len(self):
            raise IndexError(f"the animation has {len(self)} pictures")
        return place

"""Objects of scenes: attributes are the keys of the scene file, and what the file does not know is refused at once."""

import difflib
from typing import Any, ClassVar, dataclass_transform


@dataclass_transform(kw_only_default=True)
class Node:
    """An object of a scene. Attributes are its keys; one that is not set is None, or an empty object that can be filled."""

    #: By attribute: the key in the file, and the class of objects or of a list's objects (None: plain values).
    _keys: ClassVar[dict[str, tuple[str, type | None, bool]]] = {}

    def __init__(self, **keys: Any) -> None:
        object.__setattr__(self, "_values", {})
        for key, value in keys.items():
            setattr(self, key, value)

    def __getattr__(self, name: str) -> Any:
        # Only called for what is no real attribute.
        if name.startswith("__") or name not in self._keys:
            raise AttributeError(self._unknown(name))
        _, kind, is_list = self._keys[name]
        values = self.__dict__["_values"]
        if name not in values and kind is not None:
            values[name] = [] if is_list else kind()
        return values.get(name)

    def __setattr__(self, name: str, value: Any) -> None:
        if name not in self._keys:
            raise AttributeError(self._unknown(name))
        if value is None:
            self._values.pop(name, None)
            return
        _, kind, is_list = self._keys[name]
        if kind is not None and is_list:
            value = [kind.from_dict(item) if isinstance(item, dict) else item for item in value]
        elif kind is not None and isinstance(value, dict):
            value = kind.from_dict(value)
        self._values[name] = value

    def __delattr__(self, name: str) -> None:
        setattr(self, name, None)

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self._keys})

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and self.to_dict() == other.to_dict()

    __hash__ = None

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{key}={value!r}' for key, value in self._said().items())})"

    def to_dict(self) -> dict[str, Any]:
        """As JSON has it. Objects that say nothing are left out."""
        return {self._keys[name][0]: _plain(value) for name, value in self._said().items()}

    @classmethod
    def from_dict(cls, values: dict[str, Any]) -> "Node":
        """The inverse of to_dict."""
        names = {key: name for name, (key, _, _) in cls._keys.items()}
        node = cls()
        for key, value in values.items():
            setattr(node, names.get(key, key), value)
        return node

    def _said(self) -> dict[str, Any]:
        return {name: value for name, value in self._values.items() if not _is_nothing(value)}

    def _unknown(self, name: str) -> str:
        near = difflib.get_close_matches(name, self._keys, n=1)
        return f"{type(self).__name__} has no key '{name}'" + (f"; did you mean '{near[0]}'?" if near else "")


def _is_nothing(value: Any) -> bool:
    return (isinstance(value, Node) and not value._said()) or (isinstance(value, list) and not value)


def _plain(value: Any) -> Any:
    if isinstance(value, Node):
        return value.to_dict()
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if hasattr(value, "tolist"):  # Of numpy: arrays and numbers.
        return value.tolist()
    return value

"""Everything that is public has types and an explanation."""

import ast
import inspect
import unittest
from pathlib import Path

import elvis


def public(thing) -> set[str]:
    return {name for name in vars(thing) if not name.startswith("_")}


class Stubs(unittest.TestCase):
    def test_the_module_in_c_is_in_its_stub(self):
        stub = Path(elvis.__file__).with_name("_elvis.pyi")
        kinds = (ast.FunctionDef, ast.ClassDef)
        tree = [node for node in ast.parse(stub.read_text()).body if isinstance(node, kinds)]
        self.assertEqual({node.name for node in tree}, public(elvis._elvis))
        for node in tree:
            if isinstance(node, ast.ClassDef):
                methods = {method.name for method in node.body if isinstance(method, kinds) and not method.name.startswith("_")}
                self.assertEqual(methods, public(getattr(elvis._elvis, node.name)), node.name)

    def test_what_is_public_is_typed_and_explained(self):
        for name in elvis.__all__:
            thing = getattr(elvis, name)
            functions = [thing] if inspect.isfunction(thing) else [method for key, method in vars(thing).items()
                                                                   if inspect.isfunction(method) and not key.startswith("_")]
            for function in functions:
                signature = inspect.signature(function)
                types = [parameter.annotation for key, parameter in signature.parameters.items() if key != "self"]
                self.assertNotIn(inspect.Parameter.empty, [*types, signature.return_annotation], function.__qualname__)
                self.assertTrue(function.__doc__, function.__qualname__)


if __name__ == "__main__":
    unittest.main()

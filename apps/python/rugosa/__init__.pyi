from os import PathLike
from typing import Any, Callable, Iterable, List, Optional, Sequence, Tuple, Union

import numpy
from numpy.typing import ArrayLike, NDArray

Array = NDArray[numpy.float64]
File = Union[str, PathLike]
Pair = Union[float, Tuple[float, float]]
Nodes = Union[int, Tuple[int, int]]

__version__: str

class InputError(ValueError): ...
class UsageError(ValueError): ...
class NotConverged(RuntimeError): ...

class Genome:
    scale: float
    genes: Array
    def __init__(self, content: dict) -> None: ...
    @staticmethod
    def read(file: File) -> "Genome": ...
    def to_dict(self) -> dict: ...
    def with_genes(self, genes: Sequence[float]) -> "Genome": ...
    def profile(self, nodes: Nodes = ..., length: Pair = ..., kernel: str = ...) -> Union["Profile", "Surface"]: ...

class Profile:
    heights: Array
    spacing: float
    nodes: int
    def __init__(self, heights: ArrayLike, spacing: float, fill: bool = ..., max_filled: float = ...) -> None: ...
    def __len__(self) -> int: ...
    def roughness(self) -> dict: ...
    def spectrum(self) -> Tuple[Array, Array]: ...
    def plot(self, axes: Any = ..., **style: Any) -> Any: ...

class Surface:
    heights: Array
    spacing: Tuple[float, float]
    nodes: Tuple[int, int]
    def __init__(self, heights: ArrayLike, spacing: Pair, fill: bool = ..., max_filled: float = ...) -> None: ...
    def roughness(self, periodic: bool = ...) -> dict: ...
    def row(self, row: int) -> Profile: ...
    def plot(self, axes: Any = ..., **style: Any) -> Any: ...

class Curve:
    displacement: Array
    pressure: Array
    contact_fraction: Array
    tangent_stiffness: Array
    interface_stiffness: Array
    contact_fraction_low: Array
    contact_fraction_high: Array
    tangent_stiffness_low: Array
    tangent_stiffness_high: Array
    kkt_residual: Array
    full_stiffness: float
    height_range: float
    solver: str
    account: str
    pressure_gradient: Array
    displacement_gradient: Array
    smooth_contact_fraction: Array
    contact_fraction_gradient: Array
    def __len__(self) -> int: ...
    def secant_stiffness(self) -> Tuple[Array, Array]: ...
    @property
    def slip_assumption(self) -> str: ...
    def partial_slip(self, friction: float) -> Tuple[Array, Array, Array, Array]: ...
    def plot(self, axes: Any = ..., **style: Any) -> Any: ...

class Target:
    x: Array
    y: Array
    quantity: str
    weight: float
    def __init__(self, x: ArrayLike, y: ArrayLike, quantity: str = ..., weight: float = ...) -> None: ...
    @staticmethod
    def read(file: File, **scales: object) -> "Target": ...
    @staticmethod
    def like(surface: Union[Profile, Surface, Genome, ArrayLike], spacing: Optional[Pair] = ..., *, quantity: str = ...,
             points: int = ..., last: Optional[float] = ..., **model: Any) -> "Target": ...
    def to_csv(self) -> str: ...
    def __len__(self) -> int: ...

class Answer:
    genome: Genome
    similarity: float
    similarity_refined: Optional[float]
    similarity_worst: Optional[float]
    within_limits: bool

class Design:
    genome: Genome
    profile: Union[Profile, Surface]
    heights: Array
    spacing: Pair
    similarity: float
    similarity_refined: Optional[float]
    similarity_worst: Optional[float]
    found: bool
    bound: float
    out_of_reach: List[str]
    alternatives: List[Answer]
    targets: List[Target]
    curve: Curve
    interrupted: bool
    evaluations: int
    price: float
    pipeline: str
    notes: List[str]
    stopped: str
    tolerance: dict
    def trust(self, *, noise: float = ..., tilt: float = ..., hardness: Optional[float] = ..., seed: int = ..., threads: int = ...) -> dict: ...
    def plot(self, axes: Any = ...) -> Any: ...

class Stored:
    index: int
    similarity: float
    similarity_worst: float
    genome: Genome

class Database:
    def __init__(self, file: File) -> None: ...
    @staticmethod
    def create(file: File, genomes: Optional[int] = ..., **options: Any) -> "Database": ...
    def build(self, genomes: int, **options: Any) -> None: ...
    def query(self, targets: Union[Target, List[Target]], best: Optional[int] = ..., **options: Any) -> List[Stored]: ...
    def genome(self, index: int) -> Genome: ...
    def __len__(self) -> int: ...

class Optimisation:
    best: Optional[NDArray]
    objectives: List[float]
    front: List[Tuple[NDArray, List[float]]]
    population: NDArray
    evaluations: int
    failures: int
    price: float
    level: str
    pipeline: str
    stopped: str
    notes: List[str]
    interrupted: bool

class Search:
    levels: list[str]
    def ask(self) -> NDArray: ...
    def tell(self, answers: Iterable[Any]) -> None: ...
    def result(self) -> Optimisation: ...

def read(file: File, *, surface: bool = ..., unit: str = ..., spacing: Pair = ..., detrend: str = ..., fill: bool = ...,
         max_filled: float = ..., row: int = ..., outliers: str = ..., lambda_s: float = ..., lambda_c: float = ...) -> Union[Profile, Surface, Genome]: ...
def contact(heights: Union[ArrayLike, Profile, Surface, Genome], spacing: Optional[Pair] = ..., *, gradient: bool = ...,
            area_gradient: bool = ..., **model: Any) -> Curve: ...
def design(target_pressure: Optional[ArrayLike] = ..., target_stiffness: Optional[ArrayLike] = ...,
           **options: Any) -> Design: ...
def optimise(problem: Any, *, lower: Optional[ArrayLike] = ..., upper: Optional[ArrayLike] = ..., bits: int = ...,
             permutation: int = ..., pipeline: str = ..., variant: str = ..., levels: str = ...,
             minimise: Union[bool, Sequence[bool]] = ..., objectives: int = ..., evaluations: int = ...,
             seconds: float = ..., max_failures: float = ..., seed: int = ..., start: ArrayLike = ..., operators: Iterable[Any] = ...,
             observers: Iterable[Callable[[dict], Any]] = ...) -> Optimisation: ...
def search(*, lower: Optional[ArrayLike] = ..., upper: Optional[ArrayLike] = ..., bits: int = ..., permutation: int = ...,
           pipeline: str = ..., variant: str = ..., levels: str = ..., minimise: Union[bool, Sequence[bool]] = ..., objectives: int = ...,
           evaluations: int = ..., seconds: float = ..., max_failures: float = ..., seed: int = ...,
           start: ArrayLike = ..., operators: Iterable[Any] = ..., observers: Iterable[Callable[[dict], Any]] = ...) -> Search: ...

"""Multi-objective optimisers as DEAP toolboxes over arrays."""

from .gamultiobj import Gamultiobj as Gamultiobj
from .minimise import Run as Run
from .minimise import minimise as minimise
from .moead_dra import MoeadDra as MoeadDra
from .nsga2 import Nsga2 as Nsga2
from .sampling import Sampling as Sampling

# The public names of this module, and the only list of them: the package reads this file, type
# checkers and docs/api.py do too. "# -- " begins a group.

# -- Results
from gearlube.report.result import Result as Result

# -- Trains of bodies and elements
from gearlube.studies.drivetrain.cycle import train_cycle as train_cycle
from gearlube.studies.drivetrain.losses import map_losses as map_losses
from gearlube.studies.drivetrain.ramp import run_ramp as run_ramp
from gearlube.studies.drivetrain.run import run_drivetrain as run_drivetrain

# -- Design of a hypoid pair
from gearlube.studies.design.run import run_design as run_design

# -- Quieter flanks of a pair
from gearlube_core.flank_optimisation.optimise import OptimiseSettings as OptimiseSettings
from gearlube.studies.optimise.run import run_optimise as run_optimise

# -- Measured gears
from gearlube.studies.measured.run import run_measured as run_measured
from gearlube.studies.measured.teeth import run_tooth_errors as run_tooth_errors

# -- Tooth contact of a hypoid pair
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings as ContactSettings
from gearlube.studies.contact.run import run_contact as run_contact
from gearlube_core.hypoid_contact.sensitivity.analysis import (
    SensitivitySettings as SensitivitySettings,
)
from gearlube.studies.contact.sensitivity import run_sensitivity as run_sensitivity
from gearlube.studies.contact.sensitivity import sensitivity_rows as sensitivity_rows

# -- Whine of a hypoid pair against its settings
from gearlube_core.hypoid_contact.sensitivity.series_rates import SeriesSettings as SeriesSettings
from gearlube.studies.whine.run import WhineSettings as WhineSettings
from gearlube.studies.whine.run import run_whine as run_whine

# -- Friction of a bearing
from gearlube.studies.bearing.run import BearingSettings as BearingSettings
from gearlube.studies.bearing.run import run_bearing as run_bearing

# -- Drive cycle of an axle
from drivetrain.cycle.traces import DriveCycle as DriveCycle
from gearlube.studies.drive_cycle.settings import LossGrid as LossGrid
from drivetrain.sump_heat import SumpHeat as SumpHeat
from drivetrain.steady_temperature import steady_temperature as steady_temperature

# -- Damage of an axle or a pair over a duty cycle
from gearlube.damage.bins import read_bins as read_bins
from gearlube.damage.bins import cycle_bins as cycle_bins
from gearlube.damage.settings import DamageSettings as DamageSettings
from gearlube.damage.run import run_damage as run_damage
from gearlube.damage.pair import pair_settings as pair_settings

# -- Helical pair
from gearlube.studies.helical.settings import HelicalSettings as HelicalSettings
from gearlube.studies.helical.run import run_helical as run_helical

# -- Resonance
from gearlube.studies.resonance.settings import ResonanceSettings as ResonanceSettings
from gearlube.studies.resonance.run import run_resonance as run_resonance

# -- Vehicle speed sweep
from gearlube.studies.sweep.settings import quick_sweep_settings as quick_sweep_settings
from gearlube.studies.sweep.datasets import load_sweep as load_sweep
from gearlube.studies.sweep.report import write_sweep_report as write_sweep_report

# -- Run-up and coast-down
from gearlube.studies.runup.run import load_runup as load_runup
from gearlube.studies.runup.animation.dataset import animate_ramp as animate_ramp
from gearlube.studies.sound.settings import SoundSettings as SoundSettings
from gearlube.studies.sound.run import run_sound as run_sound

# -- Variation of any parameter
from gearlube.variation.point_study import point_study as point_study
from gearlube.variation.design import Axis as Axis
from gearlube.variation.design import Spread as Spread
from gearlube.variation.design import Sampling as Sampling
from gearlube.variation.design import Design as Design
from gearlube.variation.run import run_variation as run_variation
from gearlube.variation.store import open_variation as open_variation
from gearlube.variation.store import gridded as gridded

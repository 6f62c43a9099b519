import sys,json,time
from pathlib import Path
from gearlube.studies.film_model.plan import FilmPlan
from gearlube.studies.film_model.solves import *
from gearlube.studies.film_model.fit import FitSettings, fit_model
from gearlube.studies.film_model.calibration import tests_table
from gearlube.studies.film_model.kinds import KINDS
kind,name,out=sys.argv[1:4]; pts=int(sys.argv[4]); steps=int(sys.argv[5]); dirs=sys.argv[6:]
plan=FilmPlan.of(json.loads((Path(dirs[0])/"plan.json").read_text()))
rows={}
for i,d in enumerate(dirs):
    for r in SolveTable(Path(d)/"solves.csv",KINDS[kind]).rows.values():
        r=r._replace(task=r.task._replace(number=r.task.number+10000*i)); rows[row_key(r.task)]=r
from gearlube.studies.film_model import samples,line_samples
K=KINDS[kind]
F={'flank':samples._fits,'line':line_samples.line_fits,'roller':line_samples.roller_fits}[kind]
n0=len(rows)
rows={k:r for k,r in rows.items() if F(r.task.contact, K.domain if r.task.kind in('calibration','fresh') else K.trained)}
print('rows',n0,len(rows))
t=time.time()
def pr(s,w): print(round(time.time()-t),round(s,3),w,flush=True)
import os
done=0
f=fit_model(list(rows.values()),plan,FitSettings(points=pts,steps=steps),name=name,progress=pr)
f.model.write(Path(out)); Path(out).with_name(name+"_tests.csv").write_text(tests_table(f.predicted,f.solved))
print(json.dumps({k:v for k,v in f.model.provenance.items() if k not in("box",)},indent=0)); print(f.model.checksum)

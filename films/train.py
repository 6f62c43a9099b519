import sys,math
from pathlib import Path
from gearlube.studies.film_model.plan import FilmPlan, FilmTask
from gearlube.studies.film_model.solves import *
from gearlube.studies.film_model.solves import SOLVES
from gearlube_core.oil.lubricant import lubricant_names
import time
def run(plan, out, part=None):
    out=Path(out); check_plan(plan,out)
    t=time.time(); tasks=plan.tasks(); print(out, len(tasks), time.time()-t, flush=True)
    table=SolveTable(out/SOLVES, plan.kind); out.mkdir(parents=True,exist_ok=True)
    (out/"plan.json").write_text(json.dumps(plan.described(),indent=1))
    # interleave so that any stop leaves all sets
    import random
    order=list(range(len(tasks))); 
    by={}
    for x in tasks: by.setdefault((x.kind,x.nodes),[]).append(x)
    keyed=[]
    for g in by.values():
        for i,x in enumerate(g): keyed.append(((i+.5)/len(g),x))
    keyed.sort(key=lambda z:z[0])
    if part is not None: keyed=[x for i,x in enumerate(keyed) if i%2==part]
    n=0
    for _,x in keyed:
        if table.read(row_key(x)) is not None: continue
        try: r=solve_task(x)
        except Exception as e: r=failed_row(x,e)
        table.keep(row_key(x),r); n+=1
        if n%20==0: print(out.name,n,len(keyed),time.process_time(),flush=True)
import json
O=lubricant_names()
from gearlube.studies.film_model import samples as SS
for what in sys.argv[1:]:
    if what=="roller": run(FilmPlan(contact="roller",oils=O,box=380,visited=110,edge=60,calibration=160,fresh=100,fine_box=40,fine_visited=20,fine_edge=10,fine_fresh=20,fine_calibration=0),"films/roller")
    if what=="line": run(FilmPlan(contact="line",oils=O,box=850,visited=220,edge=80,calibration=200,fresh=120,fine_box=60,fine_visited=30,fine_edge=15,fine_fresh=20,fine_calibration=40),"films/line")
    if what.startswith("flank"): run(FilmPlan(contact="flank",oils=O,box=1050,visited=300,edge=110,calibration=240,fresh=120,fine_box=45,fine_visited=25,fine_edge=12,fine_fresh=6,fine_calibration=0,seed=20 if what=="flank0" else 900+int(what[5:])),"films/flank"+what[5:], 0 if what=="flank0" else None)
    if what=="line2": run(FilmPlan(contact="line",oils=O,box=2400,visited=350,edge=50,calibration=60,fresh=30,fine_box=60,fine_visited=20,fine_edge=5,fine_fresh=5,fine_calibration=10,seed=77),"films/line2")

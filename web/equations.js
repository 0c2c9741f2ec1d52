// Each input beside its equation and its source. The equations are the core's (crates/carom/src, one file a mechanism).
"use strict";

const KD = ["Kim & Dunn 2007", "10.1016/j.jaerosci.2007.03.006"];
const TN = ["Thornton & Ning 1998", "10.1016/S0032-5910(98)00099-0"];
const DAHNEKE = ["Dahneke 1971", "10.1016/0021-9797(71)90302-X"];
const TABOR = ["Tabor 1948", "10.1098/rspa.1948.0008"];
const LEDGER = "e^{2}=1−Σ ε_{i}(v)";
const WORK = "Ψ_{A}=\\frac{8π}{3}C_{R} f_{0}{(\\frac{5}{4K})}^{3/5}{(\\frac{r}{m^{2}})}^{1/5}v^{−4/5}";

const LAWS = {
  ea: [`${LEDGER}, ε=Ψ_{A}(1+C_{A}v)+Ψ_{H}C_{H}, ${WORK}`, KD, "Eqs 16–24"],
  eap: [`e^{2}=e_{pl}^{2}−Ψ_{A}−…, V_{y}=\\frac{9}{8\\sqrt{5}}\\frac{η^{5/2}r^{3/2}}{{E^{*}}^{2}m^{1/2}}, η=πλk`, KD, "Eqs 29–37"],
  "thornton-ning": ["e^{2}=\\frac{6\\sqrt{3}}{5}(1−\\frac{q^{2}}{6})\\sqrt{\\frac{q}{q+2\\sqrt{6/5−q^{2}/5}}}−\\frac{V_{s}^{2}}{v^{2}}, q=V_{y}/v", TN, ""],
  tabor: ["V=κ{(v^{2}−βV^{2})}^{β}, β=\\frac{2n−1}{2n+4}", TABOR, ""],
  dahneke: ["{(V/v)}^{2}=e^{2}−\\frac{E_{out}−e^{2}E_{in}}{½mv^{2}}", DAHNEKE, ""],
  constant: ["e=\\text{const}", null, "a table, no mechanics"],
  "by-angle": ["e=e(α)", ["Grant & Tabakoff 1975", "10.2514/3.59826"], "for grant-tabakoff"],
  resolved: ["m\\ddot{x}=−\\sqrt{r}K x^{3/2}(1+C_{H}\\dot{x})+2πaf_{0}C_{R}(1−C_{A}\\dot{x})", KD, "Eqs 4, 8–12"],
  losses: [LEDGER, KD, "any losses of different kinds"],
};

const TANGENTIALS = {
  rolling: ["μ=min(f, \\frac{2}{7}\\frac{|v_{s}|}{(1+e)v_{n}})", KD, "§3.2; Eq. 25 corrected"],
  walton: ["μ=min(f, \\frac{2}{7}\\frac{(1+β_{0})|v_{s}|}{(1+e)v_{n}})", ["Foerster et al. 1994", "10.1063/1.868282"], ""],
  "micro-slip": ["P=fv_{n}π(ψ,κ,e), ψ=\\frac{|v_{s}|}{fv_{n}}, κ=\\frac{G^{*}}{E^{*}}", ["Maw, Barber & Fawcett 1976", "10.1016/0043-1648(76)90201-5"], ""],
  constant: ["V_{t}=e_{t}v_{t}", null, "the spin stays"],
  "by-angle": ["V_{t}=e_{t}(α)v_{t}", null, "the spin stays"],
};

const KEYS = {
  sphere: ["K=\\frac{4}{3π(k_{1}+k_{2})}, k_{i}=\\frac{1−ν_{i}^{2}}{πE_{i}}", KD, "Eqs 5, 6"],
  surface: ["w=2Φ\\sqrt{γ_{1}γ_{2}}, k=σ/2", KD, "Eqs 17, 18"],
  diameter: ["m=\\frac{π}{6}ρd^{3}", null, ""],
  speed: ["v_{n}=v sin α", null, "the normal speed goes into e"],
  angle: ["tan α_{crit}=\\frac{2}{7f(1+e)}", KD, "Eq. 25 corrected"],
  spin: ["v_{s}=v_{t}−Rω", null, "slip of the contact point"],
  friction: ["μ≤f", KD, "§3.2"],
  walton_beta: ["v_{s}′=−β_{0}v_{s}", ["Foerster et al. 1994", "10.1063/1.868282"], ""],
  roughness_factor: ["F_{A}=2πaf_{0}C_{R}", KD, "Eqs 16–21"],
  roughness: ["C_{R}=\\frac{1}{{(1+1.485σ_{r}/z_{0})}^{2}}", ["Rabinovich et al. 2000", "10.1006/jcis.2000.7167"], ""],
  roughness_model: ["C_{R}(σ_{r})", ["Fuller & Tabor 1975", "10.1098/rspa.1975.0138"], "or Rabinovich"],
  asperity_radius: ["θ=\\frac{E^{*}σ_{r}^{3/2}}{β^{1/2}w}", ["Fuller & Tabor 1975", "10.1098/rspa.1975.0138"], ""],
  roughness_angle: ["p(γ)∝e^{−γ^{2}/2Δγ^{2}}\\frac{sin(α+γ)}{sin α}", ["Sommerfeld & Huber 1999", "10.1016/S0301-9322(99)00037-6"], "here: the median facet"],
  adhesion_damping: ["ε=Ψ_{A}C_{A}v", KD, "Eq. 22"],
  hertz_damping: ["ε=\\frac{5}{2}{(\\frac{2}{3})}^{5/2}C_{H}v", KD, "Eq. 23"],
  surface_curvature: ["\\frac{1}{r}=\\frac{1}{R}+\\frac{1}{r_{s}}", ["Johnson 1985", "10.1017/CBO9781139171731"], ""],
  restitution: ["e=V_{n}/v_{n}", null, "given, not computed"],
  tangential_restitution: ["e_{t}=V_{t}/v_{t}", null, "given, not computed"],
  yield_velocity: ["e=1, v≤V_{y}", TABOR, "fitted"],
  meyer_index: ["β=\\frac{2n−1}{2n+4}", TABOR, ""],
  limiting_pressure: ["V_{y}^{2}=\\frac{π^{5}}{30}\\frac{p_{y}^{5}r^{3}}{{E^{*}}^{4}m}", TN, ""],
  interfacial_parameter: ["w=2Φ\\sqrt{γ_{1}γ_{2}}", KD, "Eq. 18"],
  equilibrium_spacing: ["μ_{T}={(\\frac{rw^{2}}{{E^{*}}^{2}z_{0}^{3}})}^{1/3}", KD, "Eq. 39"],
  work_of_adhesion: ["f_{0}={(\\frac{9Krw^{2}}{2π})}^{1/3}", KD, "Eq. 16"],
  stiffness: ["K=\\frac{4}{3}E^{*}", KD, "Eq. 5"],
  plastic_constant: ["k=σ/2", KD, "§4"],
  dynamic_strength_factor: ["k→factor·k", null, "strain rate and size"],
  well_depth: ["E_{in}", DAHNEKE, ""],
  well_depth_out: ["E_{out}≥E_{in}", DAHNEKE, ""],
  hamaker_constant: ["E=\\frac{Ar}{6z_{0}}", DAHNEKE, ""],
  adhesion: ["F_{A}\\text{ on separation, or always}", KD, "Eq. 4"],
};

/** A small part of TeX as MathML: _{} ^{} \frac{}{} \sqrt{} \text{} \dot{} \ddot{} and groups. */
function mathml(source) {
  let at = 0;
  const group = () => {
    at += 1; // {
    const inner = row("}");
    at += 1;
    return `<mrow>${inner}</mrow>`;
  };
  const raw = () => {
    const end = source.indexOf("}", at);
    const text = source.slice(at + 1, end);
    at = end + 1;
    return escapeXml(text);
  };
  const atom = () => {
    const rest = source.slice(at);
    if (rest[0] === "{") return group();
    const word = /^\\([a-z]+)/.exec(rest);
    if (word) {
      at += word[0].length;
      switch (word[1]) {
        case "frac": return `<mfrac>${group()}${group()}</mfrac>`;
        case "sqrt": return `<msqrt>${group()}</msqrt>`;
        case "dot": return `<mover accent="true">${group()}<mo>˙</mo></mover>`;
        case "ddot": return `<mover accent="true">${group()}<mo>¨</mo></mover>`;
        default: return `<mtext>${raw()}</mtext>`;
      }
    }
    const name = /^(sin|tan|min|factor|out|in|pl|crit|const)\b/.exec(rest) ?? /^(out|in|pl|crit)(?=\})/.exec(rest);
    const number = /^[\d.½/]*[\d½]/.exec(rest);
    const taken = name?.[0] ?? number?.[0] ?? rest[0];
    at += taken.length;
    if (name) return /sin|tan/.test(taken) ? `<mi>${taken}</mi><mspace width="0.2em"></mspace>` : `<mi>${taken}</mi>`;
    if (number) return `<mn>${taken}</mn>`;
    if (taken === " ") return "";
    if (taken === ",") return "<mo>,</mo><mspace width=\"0.7em\"></mspace>";
    return /[\p{L}∗]/u.test(taken) ? `<mi>${taken}</mi>` : `<mo>${escapeXml(taken)}</mo>`;
  };
  const row = (end) => {
    let out = "";
    while (at < source.length && source[at] !== end) {
      let base = atom(), sub = null, sup = null;
      while (source[at] === "_" || source[at] === "^") {
        const kind = source[at];
        at += 1;
        if (kind === "_") sub = atom();
        else sup = atom();
      }
      if (sub && sup) base = `<msubsup>${base}${sub}${sup}</msubsup>`;
      else if (sub) base = `<msub>${base}${sub}</msub>`;
      else if (sup) base = `<msup>${base}${sup}</msup>`;
      out += base;
    }
    return out;
  };
  return `<math>${row("")}</math>`;
}

/** An equation with its source. */
function equation(entry) {
  if (!entry) return "";
  const [tex, source, where] = entry;
  const link = source ? `<a href="https://doi.org/${source[1]}">${escapeXml(source[0])}</a>` : "";
  const told = [link, escapeXml(where)].filter(Boolean).join(", ");
  return `<span class="eq">${mathml(tex)}</span>${told ? ` <cite>${told}</cite>` : ""}`;
}
